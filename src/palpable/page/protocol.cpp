// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/protocol.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include <nlohmann/json.hpp>

namespace palpable::page::protocol {
namespace {

using Json = nlohmann::json;

std::string quoted(std::string_view field) { return "'" + std::string(field) + "'"; }

template <class T>
concept Object = requires(T object) {
  T::each_field(object, [](const auto&...) {});
};

// Reads the fields of one message or nested object and keeps the first error message.
class FieldReader {
 public:
  /// `besides`: number of keys other than fields.
  FieldReader(const Json& object, std::size_t besides) : object_(object), expected_(besides) {}

  template <class T>
  void operator()(const char* name, T& value, const Limits& limits) {
    if (!complaint_.empty()) return;
    ++expected_;
    const auto found = object_.find(name);
    if (found == object_.end()) {
      complaint_ = "the field " + quoted(name) + " is missing";
    } else {
      read(name, *found, value, limits);
    }
  }
  /// Empty if every field was read and there are no unknown ones.
  std::string complaint() const {
    if (complaint_.empty() && object_.size() != expected_)
      return "there are fields that the message does not have";
    return complaint_;
  }

 private:
  void read(const char* name, const Json& json, bool& value, const Limits&) {
    if (json.is_boolean()) {
      value = json.get<bool>();
    } else {
      complaint_ = quoted(name) + " must be true or false";
    }
  }
  void read(const char* name, const Json& json, double& value, const Limits& limits) {
    // The comparison also refuses NaN and infinity.
    if (json.is_number() && json.get<double>() >= limits.lowest && json.get<double>() <= limits.highest) {
      value = json.get<double>();
    } else {
      complaint_ = quoted(name) + " must be a number within its limits";
    }
  }
  void read(const char* name, const Json& json, std::int64_t& value, const Limits& limits) {
    double number = 0.0;
    read(name, json, number, limits);
    if (!json.is_number_integer() && complaint_.empty())
      complaint_ = quoted(name) + " must be a whole number";
    if (complaint_.empty()) value = json.get<std::int64_t>();
  }
  void read(const char* name, const Json& json, std::string& value, const Limits& limits) {
    if (json.is_string() && json.get_ref<const std::string&>().size() <= limits.longest) {
      value = json.get<std::string>();
    } else {
      complaint_ = quoted(name) + " must be a text of at most " + std::to_string(limits.longest) + " bytes";
    }
  }
  template <class T>
  void read(const char* name, const Json& json, std::optional<T>& value, const Limits& limits) {
    value.reset();
    if (!json.is_null()) read(name, json, value.emplace(), limits);
  }
  template <class T>
  void read(const char* name, const Json& json, std::vector<T>& values, const Limits& limits) {
    if (!json.is_array() || json.size() > limits.most) {
      complaint_ = quoted(name) + " must be a list of at most " + std::to_string(limits.most) + " values";
      return;
    }
    values.clear();
    values.reserve(json.size());
    for (const Json& element : json) {
      read(name, element, values.emplace_back(), limits);
      if (!complaint_.empty()) return;
    }
  }
  template <Object T>
  void read(const char* name, const Json& json, T& value, const Limits&) {
    if (!json.is_object()) {
      complaint_ = quoted(name) + " must be an object";
      return;
    }
    FieldReader reader(json, 0);
    T::each_field(value, reader);
    if (const auto complaint = reader.complaint(); !complaint.empty())
      complaint_ = quoted(name) + ": " + complaint;
  }

  const Json& object_;
  std::size_t expected_;
  std::string complaint_;
};

Json written(bool value, const Limits&) { return value; }
Json written(double value, const Limits& limits) {
  return std::isfinite(value) ? std::clamp(value, limits.lowest, limits.highest) : 0.0;
}
Json written(std::int64_t value, const Limits& limits) {
  return std::clamp(value, static_cast<std::int64_t>(limits.lowest),
                    static_cast<std::int64_t>(limits.highest));
}
Json written(const std::string& value, const Limits& limits) {
  if (value.size() <= limits.longest) return value;
  std::size_t end = limits.longest;
  while (end > 0 && (static_cast<unsigned char>(value[end]) & 0xC0U) == 0x80U) --end;
  return value.substr(0, end);
}
template <Object T>
Json written(const T& value, const Limits& limits);
template <class T>
Json written(const std::optional<T>& value, const Limits& limits) {
  return value ? written(*value, limits) : Json();
}
template <class T>
Json written(const std::vector<T>& values, const Limits& limits) {
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(values.size(), limits.most); ++i)
    list.push_back(written(values[i], limits));
  return list;
}
template <Object T>
Json written(const T& value, const Limits&) {
  Json object = Json::object();
  T::each_field(value, [&](const char* name, const auto& field, const Limits& limits) {
    object[name] = written(field, limits);
  });
  return object;
}

// Tries each message of a variant in turn.
template <class Messages, std::size_t kIndex = 0>
Result<Messages> parse_as_type(const Json& object, const std::string& type) {
  if constexpr (kIndex == std::variant_size_v<Messages>) {
    return invalid_input("there is no message of that type");
  } else {
    using Message = std::variant_alternative_t<kIndex, Messages>;
    if (type != Message::kType) return parse_as_type<Messages, kIndex + 1>(object, type);
    Message message;
    FieldReader reader(object, 1);
    Message::each_field(message, reader);
    if (auto complaint = reader.complaint(); !complaint.empty())
      return invalid_input(std::string(Message::kType) + ": " + complaint);
    return Messages(std::move(message));
  }
}

void append_word(std::string& out, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<char>((word >> shift) & 0xFFU));
}

template <class T>
std::string raster_frame(RasterKind kind, std::uint32_t scene, const Raster<T>& raster) {
  static_assert(std::endian::native == std::endian::little, "rasters are sent in memory order");
  std::string out;
  out.reserve(20 + raster.count() * sizeof(T));
  append_word(out, kRasterMagic);
  append_word(out, static_cast<std::uint32_t>(kind));
  append_word(out, scene);
  append_word(out, static_cast<std::uint32_t>(raster.width()));
  append_word(out, static_cast<std::uint32_t>(raster.height()));
  const std::size_t at = out.size();
  out.resize(at + raster.count() * sizeof(T));
  if (!raster.empty()) std::memcpy(out.data() + at, raster.data(), raster.count() * sizeof(T));
  return out;
}

// Each target pixel is the mean over its block of source pixels.
template <class T, class Mean>
Raster<T> block_means(const Raster<T>& raster, int longest_side, Mean mean) {
  const int longest = std::max(raster.width(), raster.height());
  if (longest <= longest_side) return raster;
  const auto side = [&](int n) {
    const auto scaled = static_cast<std::int64_t>(n) * longest_side / longest;
    return static_cast<int>(std::max<std::int64_t>(scaled, std::min(n, 2)));
  };
  const auto edge = [](int i, int to, int from) {
    return static_cast<int>(static_cast<std::int64_t>(i) * from / to);
  };
  Raster<T> out(side(raster.width()), side(raster.height()));
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      out(x, y) = mean(edge(x, out.width(), raster.width()), edge(x + 1, out.width(), raster.width()),
                       edge(y, out.height(), raster.height()), edge(y + 1, out.height(), raster.height()));
    }
  }
  return out;
}

template <class Messages>
Result<Messages> parse(std::string_view text) {
  // Deep nesting would exhaust the parser's stack, so it is refused while parsing.
  bool too_deep = false;
  const auto shallow = [&](int depth, Json::parse_event_t event, Json&) {
    const bool opens =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    if (opens && depth >= kDeepestFromPage) too_deep = true;
    return !too_deep;
  };
  const Json object = Json::parse(text.begin(), text.end(), shallow, false);
  if (too_deep || !object.is_object()) return invalid_input("the message is not a JSON object, or too deep");
  const auto type = object.find("type");
  if (type == object.end() || !type->is_string()) return invalid_input("the message has no type");
  return parse_as_type<Messages>(object, type->get<std::string>());
}

}  // namespace

Result<FromPage> parse_from_page(std::string_view text) { return parse<FromPage>(text); }

Result<FromShelf> parse_from_shelf(std::string_view text) { return parse<FromShelf>(text); }

template <class Message>
std::string write_message(const Message& message) {
  Json object = written(message, Limits{});
  object["type"] = Message::kType;
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}
template std::string write_message(const Hello&);
template std::string write_message(const Laws&);
template std::string write_message(const Scene&);
template std::string write_message(const Settings&);
template std::string write_message(const Materials&);
template std::string write_message(const State&);
template std::string write_message(const Notice&);
template std::string write_message(const Words&);
template std::string write_message(const Around&);
template std::string write_message(const Sharing&);
template std::string write_message(const Robot&);
template std::string write_message(const RobotFloor&);
template std::string write_message(const Shelf&);
template std::string write_message(const Job&);
template std::string write_message(const Uploaded&);

std::string write_floats(RasterKind kind, std::uint32_t scene, const Raster<float>& values) {
  return raster_frame(kind, scene, values);
}

std::string write_picture(RasterKind kind, std::uint32_t scene, const Raster<Rgb8>& picture) {
  static_assert(sizeof(Rgb8) == 3);
  return raster_frame(kind, scene, picture);
}

Raster<float> thinned(const Raster<float>& raster, int longest_side) {
  return block_means(raster, longest_side, [&](int x0, int x1, int y0, int y1) {
    double sum = 0.0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) sum += static_cast<double>(raster(x, y));
    return static_cast<float>(sum / ((x1 - x0) * (y1 - y0)));
  });
}

Raster<Rgb8> thinned(const Raster<Rgb8>& raster, int longest_side) {
  return block_means(raster, longest_side, [&](int x0, int x1, int y0, int y1) {
    unsigned r = 0;
    unsigned g = 0;
    unsigned b = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        r += raster(x, y).r;
        g += raster(x, y).g;
        b += raster(x, y).b;
      }
    }
    const auto n = static_cast<unsigned>((x1 - x0) * (y1 - y0));
    const auto mean = [&](unsigned sum) { return static_cast<std::uint8_t>((sum + n / 2) / n); };
    return Rgb8{mean(r), mean(g), mean(b)};
  });
}

}  // namespace palpable::page::protocol
