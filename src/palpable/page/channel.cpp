// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/channel.hpp"

#include <boost/asio/buffer.hpp>
#include <openssl/ssl.h>

namespace palpable::page {

Result<std::unique_ptr<boost::asio::ssl::context>> tls_context(const ServerCertificate& certificate) {
  using boost::asio::ssl::context;
  auto made = std::make_unique<context>(context::tls_server);
  SSL_CTX_set_min_proto_version(made->native_handle(), TLS1_2_VERSION);
  SSL_CTX_set_session_cache_mode(made->native_handle(), SSL_SESS_CACHE_OFF);
  SSL_CTX_set_options(made->native_handle(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_TICKET);
  boost::beast::error_code error;
  made->use_certificate_chain(boost::asio::buffer(certificate.certificate), error);
  if (!error) made->use_private_key(boost::asio::buffer(certificate.key), context::pem, error);
  if (error)
    return Error{ErrorCode::failed, "the certificate for guests cannot be used: " + error.message(), {}};
  return made;
}

}  // namespace palpable::page
