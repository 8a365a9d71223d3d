// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/certificate.hpp"

#include <ctime>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

namespace palpable::page {
namespace {

using Parsed = std::unique_ptr<X509, decltype(&X509_free)>;

Parsed parsed(const ServerCertificate& made) {
  BIO* memory = BIO_new_mem_buf(made.certificate.data(), static_cast<int>(made.certificate.size()));
  Parsed certificate(PEM_read_bio_X509(memory, nullptr, nullptr, nullptr), X509_free);
  BIO_free(memory);
  return certificate;
}

TEST(Certificate, IsForItsAddressAndSignedByItself) {
  const auto made = make_certificate({"192.168.1.20", "fd00::2"});
  ASSERT_TRUE(made);
  const Parsed certificate = parsed(*made);
  ASSERT_NE(certificate, nullptr);
  EXPECT_EQ(X509_check_ip_asc(certificate.get(), "192.168.1.20", 0), 1);
  EXPECT_EQ(X509_check_ip_asc(certificate.get(), "fd00::2", 0), 1);
  EXPECT_NE(X509_check_ip_asc(certificate.get(), "192.168.1.21", 0), 1);
  EXPECT_NE(X509_check_ip_asc(certificate.get(), "fd00::3", 0), 1);
  EXPECT_EQ(X509_verify(certificate.get(), X509_get0_pubkey(certificate.get())), 1);
  EXPECT_EQ(X509_get_extended_key_usage(certificate.get()), static_cast<std::uint32_t>(XKU_SSL_SERVER));
  EXPECT_EQ(X509_check_ca(certificate.get()), 0);
  EXPECT_EQ(EVP_PKEY_get_bits(X509_get0_pubkey(certificate.get())), 256);
}

TEST(Certificate, IsValidNowAndNotInThreeDays) {
  const auto made = make_certificate({"10.0.0.1"});
  ASSERT_TRUE(made);
  const Parsed certificate = parsed(*made);
  EXPECT_LT(X509_cmp_current_time(X509_get0_notBefore(certificate.get())), 0);
  EXPECT_GT(X509_cmp_current_time(X509_get0_notAfter(certificate.get())), 0);
  std::time_t later = std::time(nullptr) + 3 * 86400;
  EXPECT_LT(X509_cmp_time(X509_get0_notAfter(certificate.get()), &later), 0);
}

TEST(Certificate, HasAnotherKeyAndFingerprintEachTime) {
  const auto one = make_certificate({"10.0.0.1"});
  const auto other = make_certificate({"10.0.0.1"});
  ASSERT_TRUE(one && other);
  EXPECT_NE(one->key, other->key);
  EXPECT_NE(one->fingerprint, other->fingerprint);
  EXPECT_EQ(one->fingerprint.size(), 32U * 3U - 1U);
}

TEST(Certificate, RefusesWhatIsNoAddress) {
  EXPECT_FALSE(make_certificate({""}) || make_certificate({}));
  EXPECT_FALSE(make_certificate({"10.0.0.1,DNS:example.org"}));
  EXPECT_FALSE(make_certificate({"999.1.1.1"}));
}

}  // namespace
}  // namespace palpable::page
