// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/geometry/map_place.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace palpable {
namespace {

using Kind = MapPlace::Kind;

struct KindWords {
  Kind kind;
  std::string_view name;
  std::string_view words;
  bool is_building;
};
constexpr std::array<KindWords, 16> kKinds{{{Kind::church, "church", "church", true},
                                            {Kind::mosque, "mosque", "mosque", true},
                                            {Kind::synagogue, "synagogue", "synagogue", true},
                                            {Kind::temple, "temple", "temple", true},
                                            {Kind::station, "station", "station", true},
                                            {Kind::hospital, "hospital", "hospital", true},
                                            {Kind::school, "school", "school", true},
                                            {Kind::town_hall, "town_hall", "town hall", true},
                                            {Kind::museum, "museum", "museum", true},
                                            {Kind::library, "library", "library", true},
                                            {Kind::theatre, "theatre", "theatre", true},
                                            {Kind::roundabout, "roundabout", "roundabout", false},
                                            {Kind::bus_stop, "bus_stop", "bus stop", false},
                                            {Kind::tram_stop, "tram_stop", "tram stop", false},
                                            {Kind::crossing, "crossing", "crossing", false},
                                            {Kind::entrance, "entrance", "entrance", false}}};

const KindWords& row_of(Kind kind) {
  return *std::find_if(kKinds.begin(), kKinds.end(), [kind](const KindWords& k) { return k.kind == kind; });
}

/// A word that tells a kind. Words of languages that join words end others, too ("Marienkirche").
struct TellingWord {
  std::string_view word;
  Kind kind;
  bool ends_words = false;
};
constexpr std::array<TellingWord, 72> kTelling{{{"church", Kind::church},
                                                {"chapel", Kind::church},
                                                {"cathedral", Kind::church},
                                                {"minster", Kind::church},
                                                {"abbey", Kind::church},
                                                {"basilica", Kind::church},
                                                {"église", Kind::church},
                                                {"eglise", Kind::church},
                                                {"chapelle", Kind::church},
                                                {"cathédrale", Kind::church},
                                                {"cathedrale", Kind::church},
                                                {"basilique", Kind::church},
                                                {"kirche", Kind::church, true},
                                                {"kapelle", Kind::church, true},
                                                {"münster", Kind::church, true},
                                                {"chiesa", Kind::church},
                                                {"duomo", Kind::church},
                                                {"cattedrale", Kind::church},
                                                {"iglesia", Kind::church},
                                                {"catedral", Kind::church},
                                                {"capilla", Kind::church},
                                                {"mosque", Kind::mosque},
                                                {"mosquée", Kind::mosque},
                                                {"moschee", Kind::mosque, true},
                                                {"moschea", Kind::mosque},
                                                {"mezquita", Kind::mosque},
                                                {"synagogue", Kind::synagogue},
                                                {"synagoge", Kind::synagogue, true},
                                                {"sinagoga", Kind::synagogue},
                                                {"temple", Kind::temple},
                                                {"tempel", Kind::temple, true},
                                                {"tempio", Kind::temple},
                                                {"station", Kind::station},
                                                {"gare", Kind::station},
                                                {"bahnhof", Kind::station, true},
                                                {"hbf", Kind::station},
                                                {"stazione", Kind::station},
                                                {"estación", Kind::station},
                                                {"hospital", Kind::hospital},
                                                {"infirmary", Kind::hospital},
                                                {"hôpital", Kind::hospital},
                                                {"hopital", Kind::hospital},
                                                {"krankenhaus", Kind::hospital, true},
                                                {"spital", Kind::hospital, true},
                                                {"klinik", Kind::hospital, true},
                                                {"klinikum", Kind::hospital, true},
                                                {"ospedale", Kind::hospital},
                                                {"school", Kind::school},
                                                {"college", Kind::school},
                                                {"university", Kind::school},
                                                {"école", Kind::school},
                                                {"collège", Kind::school},
                                                {"lycée", Kind::school},
                                                {"université", Kind::school},
                                                {"schule", Kind::school, true},
                                                {"gymnasium", Kind::school, true},
                                                {"universität", Kind::school},
                                                {"scuola", Kind::school},
                                                {"escuela", Kind::school},
                                                {"rathaus", Kind::town_hall, true},
                                                {"mairie", Kind::town_hall},
                                                {"municipio", Kind::town_hall},
                                                {"ayuntamiento", Kind::town_hall},
                                                {"museum", Kind::museum, true},
                                                {"musée", Kind::museum},
                                                {"museo", Kind::museum},
                                                {"library", Kind::library},
                                                {"bibliothèque", Kind::library},
                                                {"bibliothek", Kind::library, true},
                                                {"theatre", Kind::theatre},
                                                {"théâtre", Kind::theatre},
                                                {"theater", Kind::theatre, true}}};

/// Words of streets, also as abbreviations; the last of a name in some languages, the first in others.
constexpr std::array<std::string_view, 47> kStreetWords{
    "road",     "rd",      "street",  "st.",     "lane",     "avenue", "ave",     "close",
    "drive",    "way",     "terrace", "row",     "square",   "place",  "hill",    "court",
    "crescent", "gardens", "walk",    "view",    "yard",     "rue",    "av.",     "boulevard",
    "bd",       "chemin",  "allée",   "impasse", "quai",     "ruelle", "square",  "via",
    "viale",    "piazza",  "calle",   "plaza",   "gasse",    "weg",    "platz",   "straße",
    "pont",     "tunnel",  "passage", "allee",   "bretelle", "rampe",  "escalier"};

std::string small(std::string_view text) {
  // Capital letters with accents, two bytes of UTF-8, are 32 below the small ones.
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool after_c3 = i > 0 && static_cast<unsigned char>(text[i - 1]) == 0xC3;
    const bool is_capital = after_c3 && c >= 0x80 && c <= 0x9E && c != 0x97;
    out += static_cast<char>(is_capital ? c + 0x20 : c < 0x80 ? std::tolower(c) : c);
  }
  return out;
}

std::vector<std::string> words_in(std::string_view text) {
  std::vector<std::string> words{""};
  for (const char c : small(text)) {
    if (c == ' ' || c == '-' || c == '\'' || c == ',' || c == '(' || c == ')')
      words.emplace_back();
    else
      words.back() += c;
  }
  std::erase(words, "");
  return words;
}

bool tells(const std::string& word, const TellingWord& telling) {
  return word == telling.word || (telling.ends_words && word.ends_with(telling.word));
}

bool is_of_street(const std::vector<std::string>& words) {
  const auto is_one = [](const std::string& word) {
    return std::find(kStreetWords.begin(), kStreetWords.end(), word) != kStreetWords.end() ||
           word.ends_with("strasse") || word.ends_with("straße") || word.ends_with("gasse") ||
           word.ends_with("gass") || word.ends_with("weg") || word.ends_with("platz");
  };
  return !words.empty() && (is_one(words.front()) || is_one(words.back()));
}

}  // namespace

std::string_view name_of(MapPlace::Kind kind) { return row_of(kind).name; }
std::string_view words_of(MapPlace::Kind kind) { return row_of(kind).words; }

std::string_view kind_words(MapStreet::Kind kind) {
  if (kind == MapStreet::Kind::sidewalk) return "sidewalk";
  if (kind == MapStreet::Kind::path) return "path";
  return kind == MapStreet::Kind::steps ? "steps" : "street";
}

std::optional<MapPlace::Kind> map_place_kind_from(std::string_view name) {
  for (const KindWords& row : kKinds)
    if (row.name == name) return row.kind;
  return std::nullopt;
}

bool is_special_building(MapPlace::Kind kind) { return row_of(kind).is_building; }

bool is_street_name(std::string_view name) { return is_of_street(words_in(name)); }

std::optional<MapPlace::Kind> map_place_kind_in(std::string_view place_name) {
  const auto words = words_in(place_name);
  if (is_of_street(words)) return std::nullopt;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (words[i] == "town" && words[i + 1] == "hall") return Kind::town_hall;
    if (words[i] == "hôtel" && i + 2 < words.size() && words[i + 2] == "ville") return Kind::town_hall;
  }
  // The last word counts most: "Hospital Chapel" is a chapel. In Romance languages it is the first.
  for (auto word = words.rbegin(); word != words.rend(); ++word)
    for (const TellingWord& telling : kTelling)
      if (tells(*word, telling)) return telling.kind;
  return std::nullopt;
}

std::string words_of(const MapPlace& place) {
  std::string words(words_of(place.kind));
  if (place.tactile_paving) words += " with tactile paving";
  if (place.name.empty()) return words;
  if (map_place_kind_in(place.name) == place.kind) return place.name;
  return place.name + ", " + words;
}

}  // namespace palpable
