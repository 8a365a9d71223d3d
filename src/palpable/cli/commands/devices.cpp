// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/device/drivers/open.hpp"

#include <fmt/format.h>

namespace palpable::cli {
namespace {

Result<Answer> devices() {
  Answer answer;
  answer.json["devices"] = Json::array();
  for (const device::DeviceKind& kind : device::list_devices()) {
    answer.json["devices"].push_back({{"url", kind.url},
                                      {"name", kind.name},
                                      {"description", kind.description},
                                      {"available", kind.available},
                                      {"may_be", kind.may_be},
                                      {"note", kind.note},
                                      {"advice", kind.advice}});
    answer.text += fmt::format("{:15} {}: {}\n", kind.url, kind.name, kind.description);
    if (!kind.available)
      answer.text += fmt::format("{:16}Not available here: {}. To do: {}.\n", "", kind.note, kind.advice);
    else if (kind.may_be)
      answer.text += fmt::format("{:16}Not certain: {}.\n", "", kind.note);
  }
  return answer;
}

}  // namespace

void add_devices(Program& program) {
  add_command(program, "devices", "List the devices that can be touched with",
              "  palpable devices\n"
              "  palpable touch LEFT RIGHT --device sim:",
              [](Console& /*console*/) { return devices(); });
}

}  // namespace palpable::cli
