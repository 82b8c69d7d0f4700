// SPDX-License-Identifier: GPL-3.0-or-later
// Limits the size of this process's files, to simulate a full disc.
#pragma once

#include <sys/resource.h>

#include <csignal>

namespace crackle::testing {

/// During its lifetime, writing beyond `bytes` of a file fails with EFBIG, «File too large».
class LittleRoom {
  public:
    explicit LittleRoom(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit small{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &small);
    }
    LittleRoom(const LittleRoom&) = delete;
    LittleRoom& operator=(const LittleRoom&) = delete;
    ~LittleRoom() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_ = {};
    void (*handler_)(int);
};

}  // namespace crackle::testing
