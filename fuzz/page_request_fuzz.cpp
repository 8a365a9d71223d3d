// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The lines of the input are the parts of a request. A request without the secret is never admitted.
#include "palpable/core/check.hpp"
#include "palpable/page/assets.hpp"
#include "palpable/page/http.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

using namespace palpable::page;

// Instead of the built page.
const Asset* palpable::page::find_asset(std::string_view path) {
  static constexpr Asset kIndex{"/index.html", "text/html", "<!doctype html>"};
  return path == "/" || path == kIndex.path ? &kIndex : nullptr;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::string_view kSecret = "0123456789abcdef0123456789abcdef";
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  std::array<std::string_view, 6> parts;
  for (auto& part : parts) {
    const std::size_t end = rest.find('\n');
    part = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
  }
  const Request request{parts[0], parts[1], parts[2], parts[3], parts[4], parts[5]};
  RequestHandler front(palpable::SessionAccess("the token of this session", std::string(kSecret)), 4711);
  if (front.check_upgrade(request).status == 101)
    PALPABLE_CHECK(request.cookies.find(kSecret) != std::string_view::npos);
  const Reply reply = front.answer(request);
  PALPABLE_CHECK(reply.status >= 200 && reply.status < 500);
  if (!reply.set_cookie.empty()) PALPABLE_CHECK(request.body == "the token of this session");
  return 0;
}
