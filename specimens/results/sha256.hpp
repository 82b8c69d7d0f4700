// SPDX-License-Identifier: GPL-3.0-or-later
// SHA-256 (FIPS 180-4). It identifies the inputs of a test, so that `sha256sum` can check them, and protects
// checkpoints.
#pragma once

#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace crackle {

/// Hash of data that are added piece by piece.
class Sha256 {
  public:
    Sha256();
    /// Appends bytes to the data.
    void add(std::string_view bytes);
    /// Returns the hash as 64 hexadecimal digits; may be called only once.
    std::string digits();

  private:
    struct Free {
        void operator()(evp_md_ctx_st* context) const;
    };
    std::unique_ptr<evp_md_ctx_st, Free> context_;
};

/// Returns the hash as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace crackle
