// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/jobs.hpp"
#include "palpable/sources/decoder/replies.hpp"

#include <exception>
#include <new>
#include <string>
#include <system_error>

namespace palpable::sources::decoder {

bool run_guarded(RunJob run, isolated::Job job, std::span<const std::byte> file, ReplySink& reply) {
  try {
    return run(job, file, reply);
  } catch (const std::bad_alloc&) {
    return put_error(reply,
                     invalid_input("is damaged or too large: it needs more memory than its size explains"));
  } catch (const std::system_error& e) {
    // No thread for it: no fault of the file.
    if (e.code() == std::errc::resource_unavailable_try_again) throw;
    return put_error(reply, invalid_input(std::string("is damaged: ") + e.what()));
  } catch (const std::exception& e) {
    return put_error(reply, invalid_input(std::string("is damaged: ") + e.what()));
  }
}

}  // namespace palpable::sources::decoder
