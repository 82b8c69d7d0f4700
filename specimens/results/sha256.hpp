// SPDX-License-Identifier: GPL-3.0-or-later
// SHA-256 (FIPS 180-4): names the inputs of a test so that `sha256sum` can check them, and guards checkpoints.
#pragma once

#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace crackle {

/// Of bytes that come piece by piece.
class Sha256 {
  public:
    Sha256();
    void add(std::string_view bytes);
    /// 64 hexadecimal digits; once.
    std::string digits();

  private:
    struct Free {
        void operator()(evp_md_ctx_st* context) const;
    };
    std::unique_ptr<evp_md_ctx_st, Free> context_;
};

/// 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace crackle
