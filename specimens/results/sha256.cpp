// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/sha256.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <cstddef>
#include <stdexcept>

namespace crackle {

namespace {

void expect_success(int outcome) {
    if (outcome != 1) throw std::runtime_error("SHA-256 is not available from this machine's OpenSSL");
}

}  // namespace

void Sha256::Free::operator()(evp_md_ctx_st* context) const { EVP_MD_CTX_free(context); }

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
    expect_success(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr));
}

void Sha256::add(std::string_view bytes) {
    expect_success(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
}

std::string Sha256::digits() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int length = 0;
    expect_success(EVP_DigestFinal_ex(context_.get(), digest.data(), &length));
    std::string text;
    for (std::size_t k = 0; k < length; ++k) text += fmt::format("{:02x}", digest[k]);
    return text;
}

std::string sha256(std::string_view bytes) {
    Sha256 hash;
    hash.add(bytes);
    return hash.digits();
}

}  // namespace crackle
