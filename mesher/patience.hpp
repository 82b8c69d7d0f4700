// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a mesh is still wanted: its maker counts pieces of work, and asks once in a thousand.
// Tested by tests/mesher/interrupt_test.cpp.
#pragma once

#include <cstdint>
#include <functional>

#include "mesher/mesher.hpp"

namespace crackle {

class Patience {
  public:
    /// @param interrupted  as MeshRequest has it; kept by reference
    explicit Patience(const std::function<bool()>& interrupted) : interrupted_(interrupted) {}

    /// Before a piece of work, that of one centre or cell, say. @throws MeshInterrupted
    void piece() {
        if (++pieces_ % pieces_a_question == 0) ask();
    }
    /// Before work that takes long. @throws MeshInterrupted
    void ask() const {
        if (interrupted_ && interrupted_()) throw MeshInterrupted();
    }

  private:
    static constexpr std::uint32_t pieces_a_question = 1024;

    const std::function<bool()>& interrupted_;
    std::uint32_t pieces_ = 0;
};

}  // namespace crackle
