// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/sha256.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <cstddef>
#include <stdexcept>

namespace crackle {

std::string sha256(std::string_view bytes) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int length = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
        throw std::runtime_error("SHA-256 is not available from this machine's OpenSSL");
    }
    std::string text;
    for (std::size_t k = 0; k < length; ++k) text += fmt::format("{:02x}", digest[k]);
    return text;
}

}  // namespace crackle
