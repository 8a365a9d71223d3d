// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/live_address.hpp"

#include "palpable/core/text/passwords.hpp"
#include "palpable/describe/name_search.hpp"
#include "palpable/session/touch/robot_address.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

/// The schemes of DESIGN's live sources, so that an address is never taken for the name of a file.
constexpr std::array<std::string_view, 11> kSchemes{
    "frames:", "camera:", "openni:", "freenect:", "realsense:", "rtsp:",
    "rtsps:",  "http:",   "https:",  "ros:",      "robot:"};

constexpr std::string_view kHttp = "http://";

/// "host:port", "[::1]:port" or either without a port. nullopt for no host, or a port that is none.
std::optional<std::pair<std::string, std::string>> host_and_port(std::string_view authority,
                                                                 const char* usual_port) {
  std::string_view host = authority.substr(0, authority.find(':'));
  std::string_view rest = authority.substr(host.size());
  if (authority.starts_with('[')) {
    const auto end = authority.find(']');
    if (end == std::string_view::npos) return std::nullopt;
    host = authority.substr(1, end - 1);
    rest = authority.substr(end + 1);
  }
  if (host.empty() || (!rest.empty() && !rest.starts_with(':'))) return std::nullopt;
  if (rest.empty()) return std::pair(std::string(host), std::string(usual_port));
  const auto port = rest.substr(1);
  int number = 0;
  const auto [end, fault] = std::from_chars(port.data(), port.data() + port.size(), number);
  constexpr int kMost = 65535;
  if (fault != std::errc() || end != port.data() + port.size() || number < 1 || number > kMost)
    return std::nullopt;
  return std::pair(std::string(host), std::to_string(number));
}

/// The parts of a network camera's address, without options.
struct CameraUrl {
  std::string host, port;
  /// The path with its query.
  std::string target;
  /// Host and port as written, and the name and password before them.
  std::string authority, user;
  /// The address without name and password.
  std::string shown;
};

/// `scheme`: with its "://". `usual_port`: where none is given.
Result<CameraUrl> parse_camera_url(std::string_view address, std::string_view scheme,
                                   const char* usual_port) {
  const auto usage = [&](std::string message) {
    // A name and a password that are not written as they must be cannot be told from the rest.
    const auto at = address.find('@');
    return Error{ErrorCode::usage, std::move(message),
                 std::string(at == std::string_view::npos ? address : scheme)};
  };
  if (!address.starts_with(scheme)) return usage(fmt::format("a camera's address begins with {}", scheme));
  const bool is_plain =
      std::all_of(address.begin(), address.end(), [](char c) { return c > ' ' && c < '\x7F' && c != '#'; });
  if (!is_plain)
    return usage("a camera's address has no spaces, further # or characters outside of ASCII (write %20)");
  const auto rest = address.substr(scheme.size());
  const auto before_path = rest.substr(0, rest.find_first_of("/?"));
  // A password may contain an @, a host none.
  const auto at = before_path.rfind('@');
  const auto authority = at == std::string_view::npos ? before_path : before_path.substr(at + 1);
  auto place = host_and_port(authority, usual_port);
  if (!place) return usage(fmt::format("a camera's address is {}HOST:PORT/PATH", scheme));
  CameraUrl url{std::move(place->first),
                std::move(place->second),
                std::string(rest.substr(before_path.size())),
                std::string(authority),
                std::string(at == std::string_view::npos ? std::string_view() : before_path.substr(0, at)),
                {}};
  url.shown = fmt::format("{}{}{}", scheme, url.authority, url.target);
  if (!url.target.starts_with('/')) url.target.insert(0, 1, '/');
  return url;
}

Result<sources::HttpAddress> parse_http(std::string_view address) {
  auto url = parse_camera_url(address, kHttp, "80");
  if (!url) return std::move(url).error();
  if (!url->user.empty())
    return Error{
        ErrorCode::usage,
        "names and passwords are not sent to cameras by http:, where anybody can read them; give an address "
        "that needs none, or https://",
        url->shown};
  return sources::HttpAddress{std::move(url->host), std::move(url->port), std::move(url->target),
                              std::move(url->authority), std::move(url->shown)};
}

/// The options after # of the address of a network camera.
struct CameraOptions {
  bool takes_any_certificate = false;
  /// The second camera's address; empty: none.
  std::string_view right;
};

/// certificate=any, of encrypted cameras only, and right=ADDRESS, which is the last.
Result<CameraOptions> parse_camera_options(std::string_view text, bool is_encrypted,
                                           const std::string& shown) {
  constexpr std::string_view kAny = "certificate=any", kRight = "right=";
  CameraOptions options;
  if (is_encrypted && (text == kAny || text.starts_with("certificate=any&"))) {
    options.takes_any_certificate = true;
    text.remove_prefix(std::min(text.size(), kAny.size() + 1));
    if (text.empty()) return options;
  }
  if (!text.starts_with(kRight))
    return Error{ErrorCode::usage,
                 fmt::format("after # the address of a camera may have right=ADDRESS{} only",
                             is_encrypted ? ", and before it certificate=any&," : ""),
                 shown};
  options.right = text.substr(kRight.size());
  return options;
}

Result<LiveAddress> parse_http_cameras(std::string_view address) {
  const auto hash = address.find('#');
  auto left = parse_http(address.substr(0, hash));
  if (!left) return std::move(left).error();
  HttpCameras cameras{*std::move(left), std::nullopt};
  if (hash == std::string_view::npos) return LiveAddress(std::move(cameras));
  const auto options = parse_camera_options(address.substr(hash + 1), false, cameras.left.shown);
  if (!options) return options.error();
  auto right = parse_http(options->right);
  if (!right) return std::move(right).error();
  cameras.right = *std::move(right);
  return LiveAddress(std::move(cameras));
}

/// The scheme of a camera whose stream FFmpeg reads; empty: of none.
std::string_view stream_scheme_of(std::string_view address) {
  for (const std::string_view scheme : {"rtsp://", "rtsps://", "https://"})
    if (address.starts_with(scheme)) return scheme;
  return {};
}

/// FFmpeg checks no certificate of rtsps:, so that is not done in silence.
Result<void> check_certificate(const sources::StreamAddress& address) {
  if (!address.url.starts_with("rtsps://") || address.takes_any_certificate) return {};
  return Error{
      ErrorCode::usage,
      "certificates of rtsps: cannot be checked, so anybody on the way could read and change what the camera "
      "sends, and read its password; #certificate=any after the address takes that",
      address.shown};
}

Result<LiveAddress> parse_stream_cameras(std::string_view address, std::string_view scheme) {
  const auto parse = [](std::string_view one, std::string_view its_scheme) -> Result<sources::StreamAddress> {
    auto url = parse_camera_url(one, its_scheme, "");
    if (!url) return std::move(url).error();
    return sources::StreamAddress{std::string(one), false, std::move(url->shown)};
  };
  const auto hash = address.find('#');
  if (hash != std::string_view::npos && address.substr(0, hash).find('@') == std::string_view::npos &&
      address.substr(0, address.find("://", hash)).find('@', hash) != std::string_view::npos)
    return Error{ErrorCode::usage, "in a name or password # is written %23, / %2F, ? %3F and @ %40",
                 std::string(scheme)};
  auto left = parse(address.substr(0, hash), scheme);
  if (!left) return std::move(left).error();
  StreamCameras cameras{*std::move(left), std::nullopt};
  CameraOptions options;
  if (hash != std::string_view::npos) {
    auto given = parse_camera_options(address.substr(hash + 1), scheme != "rtsp://", cameras.left.shown);
    if (!given) return std::move(given).error();
    options = *given;
  }
  cameras.left.takes_any_certificate = options.takes_any_certificate;
  if (auto checked = check_certificate(cameras.left); !checked) return std::move(checked).error();
  if (options.right.empty()) return LiveAddress(std::move(cameras));
  const auto right_scheme = stream_scheme_of(options.right);
  auto right = parse(options.right, right_scheme.empty() ? scheme : right_scheme);
  if (!right) return std::move(right).error();
  right->takes_any_certificate = options.takes_any_certificate;
  if (auto checked = check_certificate(*right); !checked) return std::move(checked).error();
  cameras.right = *std::move(right);
  return LiveAddress(std::move(cameras));
}

Result<LiveAddress> parse_frames(device::DeviceUrl url) {
  const double rate_hz = url.take_number("fps", 30.0, 0.1, 240.0);
  const int repeats = url.take_count("loop", 0, 0, 1);
  if (auto finished = url.finish(); !finished) return std::move(finished).error();
  return LiveAddress(FramesAddress{std::string(url.path()), rate_hz, repeats == 1});
}

/// "1280x480"; nullopt for anything else.
std::optional<std::pair<int, int>> size_in(std::string_view text) {
  constexpr int kMost = 16384;
  int width = 0, height = 0;
  const char* end = text.data() + text.size();
  const auto across = std::from_chars(text.data(), end, width);
  if (across.ec != std::errc() || across.ptr == end || *across.ptr != 'x') return std::nullopt;
  const auto down = std::from_chars(across.ptr + 1, end, height);
  const bool is_size = down.ec == std::errc() && down.ptr == end && width > 0 && width <= kMost &&
                       height > 0 && height <= kMost;
  return is_size ? std::optional(std::pair(width, height)) : std::nullopt;
}

/// The stereo camera of an address that names its pictures.
Result<std::optional<RosPair>> take_pair(device::DeviceUrl& url) {
  RosPair pair;
  if (auto taken = take_topics(url, {{"left", &pair.left}, {"right", &pair.right}}); !taken)
    return std::move(taken).error();
  if (pair.left.empty() && pair.right.empty()) return std::optional<RosPair>();
  if (pair.left.empty() || pair.right.empty() || pair.left == pair.right)
    return Error{ErrorCode::usage, "a stereo camera has two topics of pictures: left=/TOPIC&right=/TOPIC",
                 url.scheme() + ":" + url.path()};
  if (auto taken = take_topics(url, {{"left-info", &pair.left_info}, {"right-info", &pair.right_info}});
      !taken)
    return std::move(taken).error();
  // 0 stands for none.
  constexpr double kLeast_m = 0.001, kMost_m = 10.0;
  if (const double baseline_m = url.take_number("baseline", 0.0, kLeast_m, kMost_m); baseline_m > 0.0)
    pair.baseline_m = baseline_m;
  return std::optional(std::move(pair));
}

/// The server of HOST:PORT and its camera; leaves the url's other options.
Result<RosAddress> take_ros(device::DeviceUrl& url, std::string_view authority) {
  auto place = host_and_port(authority, "9090");
  if (!place || authority.find_first_of("/@ ") != std::string_view::npos)
    return Error{
        ErrorCode::usage,
        "the address of a rosbridge server is ros://HOST:PORT or robot:HOST:PORT, with topics as options",
        url.scheme() + ":" + url.path()};
  RosAddress address;
  address.host = std::move(place->first);
  address.port = std::move(place->second);
  auto pair = take_pair(url);
  if (!pair) return std::move(pair).error();
  address.pair = *std::move(pair);
  // Of a stereo camera the others are no options.
  if (address.pair) return address;
  if (auto taken =
          take_topics(url, {{"depth", &address.depth}, {"color", &address.colour}, {"info", &address.info}});
      !taken)
    return std::move(taken).error();
  // 0 stands for none.
  constexpr double kLeast = 1e-6, kMost = 1000.0;
  if (const double scale = url.take_number("scale", 0.0, kLeast, kMost); scale > 0.0)
    address.metres_per_unit = scale;
  return address;
}

Result<LiveAddress> parse_ros(device::DeviceUrl url) {
  const std::string_view path = url.path();
  auto address = take_ros(url, path.starts_with("//") ? path.substr(2) : std::string_view());
  if (!address) return std::move(address).error();
  if (auto finished = url.finish(); !finished) return std::move(finished).error();
  return LiveAddress(*std::move(address));
}

Result<LiveAddress> parse_robot(device::DeviceUrl url) {
  if (url.path() == "sample")
    return Error{ErrorCode::usage, "the simulated robot is no server; the command touch starts one for it",
                 "robot:sample"};
  auto pictures = take_ros(url, url.path());
  if (!pictures) return std::move(pictures).error();
  auto address = take_robot_options(url, *std::move(pictures));
  if (!address) return std::move(address).error();
  if (auto finished = url.finish(); !finished) return std::move(finished).error();
  return LiveAddress(*std::move(address));
}

Result<LiveAddress> parse_video(device::DeviceUrl url) {
  const auto usage = [&](std::string message) {
    return Error{ErrorCode::usage, std::move(message), "camera:" + url.path()};
  };
  const auto number = url.path_number(sources::kMostVideoDevice);
  if (!number) return number.error();
  sources::VideoDevice left{*number};
  const int right = url.take_count("right", -1, 0, sources::kMostVideoDevice);
  left.rate_hz = url.take_count("fps", 0, 1, 240);
  const auto format = url.take_word("format", {"", "mjpeg", "yuyv"});
  if (!format.empty())
    left.coding = format == "mjpeg" ? sources::CameraCoding::jpeg : sources::CameraCoding::yuyv;
  if (const auto text = url.take_text("size"); !text.empty()) {
    const auto size = size_in(text);
    if (!size) return usage("size is WIDTHxHEIGHT in pixels, such as 1280x480, not \"" + text + "\"");
    std::tie(left.width, left.height) = *size;
  }
  if (auto finished = url.finish(); !finished) return std::move(finished).error();
  if (right >= 0 && right == left.number) return usage("the right camera is another one than the left");
  VideoCameras cameras{left, std::nullopt};
  if (right >= 0) (cameras.right = left)->number = right;
  return LiveAddress(cameras);
}

Result<LiveAddress> parse_depth_camera(device::DeviceUrl url, sources::DepthCamera::Kind kind) {
  const auto number = url.path_number(sources::kMostDepthCamera);
  if (!number) return number.error();
  sources::DepthCamera camera;
  camera.kind = kind;
  // The first, unless one is named.
  camera.number = std::max(0, *number);
  camera.library = url.take_text("library");
  if (auto finished = url.finish(); !finished) return std::move(finished).error();
  return LiveAddress(std::move(camera));
}

}  // namespace

bool is_live_address(const std::string& input) {
  const std::string begin = describe::small_letters(input.substr(0, input.find(':') + 1));
  return std::any_of(kSchemes.begin(), kSchemes.end(), [&](auto scheme) { return begin == scheme; });
}

Result<LiveAddress> parse_live_address(const std::string& address) {
  if (const auto scheme = address.substr(0, address.find(':')); describe::small_letters(scheme) != scheme)
    return Error{ErrorCode::usage, "the scheme of an address is written in small letters",
                 without_passwords(address)};
  if (address.starts_with(kHttp)) return parse_http_cameras(address);
  if (const auto scheme = stream_scheme_of(address); !scheme.empty())
    return parse_stream_cameras(address, scheme);
  auto url = device::DeviceUrl::parse(address);
  if (!url) return std::move(url).error();
  if (url->scheme() == "frames") return parse_frames(*std::move(url));
  if (url->scheme() == "camera") return parse_video(*std::move(url));
  using Kind = sources::DepthCamera::Kind;
  if (url->scheme() == "openni") return parse_depth_camera(*std::move(url), Kind::openni);
  if (url->scheme() == "freenect") return parse_depth_camera(*std::move(url), Kind::freenect);
  if (url->scheme() == "realsense") return parse_depth_camera(*std::move(url), Kind::realsense);
  if (url->scheme() == "ros") return parse_ros(*std::move(url));
  if (url->scheme() == "robot") return parse_robot(*std::move(url));
  return Error{
      ErrorCode::usage,
      fmt::format(
          "{}: is no address of a live source; frames:FOLDER, camera:N, openni:N, freenect:N, realsense:N, "
          "ros://HOST:PORT, robot:HOST:PORT, and rtsp://, rtsps://, http:// or https://HOST:PORT/PATH are",
          url->scheme()),
      address};
}

}  // namespace palpable::session
