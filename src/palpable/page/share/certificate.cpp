// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/certificate.hpp"

#include "palpable/page/share/local_network.hpp"

#include <array>
#include <memory>

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

namespace palpable::page {
namespace {

// Clocks of phones may be late.
constexpr long kBefore_s = 3600;
constexpr long kAfter_s = 2L * 24 * 3600;

template <auto kFree>
struct Freed {
  template <class T>
  void operator()(T* object) const {
    kFree(object);
  }
};
using Certificate = std::unique_ptr<X509, Freed<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using Memory = std::unique_ptr<BIO, Freed<BIO_free>>;

Error no_certificate() {
  return {ErrorCode::failed, "the certificate for guests cannot be made: OpenSSL failed", {}};
}

bool add_extension(X509* certificate, int kind, const std::string& value) {
  const std::unique_ptr<X509_EXTENSION, Freed<X509_EXTENSION_free>> extension(
      X509V3_EXT_conf_nid(nullptr, nullptr, kind, value.c_str()));
  return extension != nullptr && X509_add_ext(certificate, extension.get(), -1) == 1;
}

// Random, positive and not zero: RFC 5280, 4.1.2.2.
bool set_serial(X509* certificate) {
  std::array<unsigned char, 16> bytes{};
  if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1) return false;
  bytes[0] = static_cast<unsigned char>((bytes[0] & 0x7FU) | 0x40U);
  const std::unique_ptr<BIGNUM, Freed<BN_free>> number(
      BN_bin2bn(bytes.data(), static_cast<int>(bytes.size()), nullptr));
  return number != nullptr && BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate)) != nullptr;
}

bool set_names(X509* certificate, const std::string& address) {
  X509_NAME* name = X509_get_subject_name(certificate);
  const auto add = [&](const char* field, const std::string& value) {
    return X509_NAME_add_entry_by_txt(name, field, MBSTRING_UTF8,
                                      reinterpret_cast<const unsigned char*>(value.c_str()), -1, -1, 0) == 1;
  };
  return add("O", "Palpable, made for this touch") && add("CN", address) &&
         X509_set_issuer_name(certificate, name) == 1;
}

/// `addresses`: "IP:10.0.0.1,IP:fd00::1".
bool fill(X509* certificate, EVP_PKEY* key, const std::string& name, const std::string& addresses) {
  constexpr long kVersion3 = 2;
  return X509_set_version(certificate, kVersion3) == 1 && set_serial(certificate) &&
         X509_gmtime_adj(X509_getm_notBefore(certificate), -kBefore_s) != nullptr &&
         X509_gmtime_adj(X509_getm_notAfter(certificate), kAfter_s) != nullptr &&
         X509_set_pubkey(certificate, key) == 1 && set_names(certificate, name) &&
         add_extension(certificate, NID_basic_constraints, "critical,CA:FALSE") &&
         add_extension(certificate, NID_key_usage, "critical,digitalSignature") &&
         add_extension(certificate, NID_ext_key_usage, "serverAuth") &&
         add_extension(certificate, NID_subject_alt_name, addresses) &&
         X509_sign(certificate, key, EVP_sha256()) > 0;
}

std::string text_of(BIO* memory) {
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(memory, &bytes);
  return {bytes, static_cast<std::size_t>(size)};
}

std::string fingerprint_of(const X509* certificate) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned size = 0;
  if (X509_digest(certificate, EVP_sha256(), bytes.data(), &size) != 1) return {};
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (unsigned k = 0; k < size; ++k) {
    if (k > 0) text.push_back(':');
    text.push_back(kDigits[bytes.at(k) >> 4U]);
    text.push_back(kDigits[bytes.at(k) & 15U]);
  }
  return text;
}

}  // namespace

Result<ServerCertificate> make_certificate(const std::vector<std::string>& addresses) {
  std::string names;
  for (const std::string& address : addresses) {
    // They become a part of an extension's text, in which a comma would begin another name.
    const auto known = ip_address(address);
    if (!known) return known.error();
    names += (names.empty() ? "IP:" : ",IP:") + known->to_string();
  }
  if (addresses.empty()) return no_certificate();
  const Key key(EVP_EC_gen("P-256"));
  const Certificate certificate(X509_new());
  if (key == nullptr || certificate == nullptr ||
      !fill(certificate.get(), key.get(), addresses.front(), names))
    return no_certificate();
  const Memory certificate_text(BIO_new(BIO_s_mem()));
  const Memory key_text(BIO_new(BIO_s_mem()));
  ServerCertificate made;
  made.fingerprint = fingerprint_of(certificate.get());
  if (certificate_text == nullptr || key_text == nullptr || made.fingerprint.empty() ||
      PEM_write_bio_X509(certificate_text.get(), certificate.get()) != 1 ||
      PEM_write_bio_PrivateKey(key_text.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) != 1)
    return no_certificate();
  made.certificate = text_of(certificate_text.get());
  made.key = text_of(key_text.get());
  return made;
}

}  // namespace palpable::page
