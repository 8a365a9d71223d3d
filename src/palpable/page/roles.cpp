// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/roles.hpp"

#include <variant>

namespace palpable::page {
namespace {

/// One overload for each kind of message: without it, the visit does not compile.
struct Rules {
  const Guest& guest;

  Ruling own(std::int64_t probe) const { return guest.probe == probe ? Ruling::pass : Ruling::refuse; }

  Ruling operator()(const protocol::Pointer& pointer) const { return own(pointer.probe); }
  Ruling operator()(const protocol::Lift& lift) const { return own(lift.probe); }
  Ruling operator()(const protocol::Find& find) const {
    return guest.probe == find.probe ? Ruling::question : Ruling::refuse;
  }
  Ruling operator()(const protocol::Ask&) const { return Ruling::question; }
  Ruling operator()(const protocol::LookAround&) const { return Ruling::question; }
  Ruling operator()(const protocol::Visible&) const { return Ruling::pass; }
  Ruling operator()(const protocol::Language&) const { return Ruling::pass; }
  Ruling operator()(const protocol::Change&) const { return Ruling::refuse; }
  Ruling operator()(const protocol::Edit&) const { return Ruling::refuse; }
  Ruling operator()(const protocol::Save&) const { return Ruling::refuse; }
  Ruling operator()(const protocol::Pause&) const { return Ruling::refuse; }
  Ruling operator()(const protocol::Recentre&) const { return Ruling::refuse; }
  Ruling operator()(const protocol::MoveExplorer&) const { return Ruling::refuse; }
  Ruling operator()(const protocol::Name&) const { return Ruling::refuse; }
  Ruling operator()(const protocol::Unname&) const { return Ruling::refuse; }
  Ruling operator()(const protocol::UndoName&) const { return Ruling::refuse; }
  // It is before another screen.
  Ruling operator()(const protocol::FollowHead&) const { return Ruling::refuse; }
  Ruling operator()(const protocol::Invite&) const { return Ruling::refuse; }
  Ruling operator()(const protocol::Withdraw&) const { return Ruling::refuse; }
  Ruling operator()(const protocol::ShowOut&) const { return Ruling::refuse; }
  // Whoever sees the danger stops it.
  Ruling operator()(const protocol::RobotOrder& order) const {
    return order.word == "stop" ? Ruling::pass : Ruling::refuse;
  }
};

std::string_view name_of(Presence presence) {
  switch (presence) {
    case Presence::coming:
      return "coming";
    case Presence::here:
      return "here";
    case Presence::asleep:
      return "asleep";
    case Presence::away:
      break;
  }
  return "away";
}

}  // namespace

Ruling ruling(const Guest& guest, const protocol::FromPage& message) {
  return std::visit(Rules{guest}, message);
}

protocol::Ask asked_by(const Guest& guest, protocol::Ask question, std::int64_t lookers_probe) {
  // What a probe feels changes nothing, so anyone may ask it of any probe.
  if (question.what != "probe") question.probe = guest.probe.value_or(lookers_probe);
  return question;
}

bool concerns(const Guest& guest, const protocol::Notice& notice, bool is_of_another_guest) {
  // A guest's own question.
  if (notice.level == "answer" && guest.probe && notice.probe == guest.probe) return true;
  if (notice.level != "motion")
    return notice.level == "fault" || notice.level == "recovered" || notice.level == "named";
  return guest.probe ? notice.probe == guest.probe : !is_of_another_guest;
}

protocol::Guest described(const Guest& guest, Presence presence) {
  return {guest.number, guest.name, std::string(name_of(guest.role)), std::string(name_of(presence)),
          guest.probe};
}

std::string_view name_of(Role role) { return role == Role::touch ? "touch" : "look"; }

std::optional<Role> role_named(std::string_view name) {
  for (const Role role : {Role::look, Role::touch})
    if (name == name_of(role)) return role;
  return std::nullopt;
}

}  // namespace palpable::page
