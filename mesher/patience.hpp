// SPDX-License-Identifier: GPL-3.0-or-later
// Checks whether meshing was cancelled. The mesher counts units of work, and every 1024 units the callback is called.
// Tested by tests/mesher/interrupt_test.cpp.
#pragma once

#include <cstdint>
#include <functional>

#include "mesher/mesher.hpp"

namespace crackle {

class Patience {
  public:
    /// @param interrupted as in MeshRequest; must outlive this object
    explicit Patience(const std::function<bool()>& interrupted) : interrupted_(interrupted) {}

    /// Call this before each unit of work, for example for one centre or cell. @throws MeshInterrupted
    void piece() {
        if (++pieces_ % pieces_a_question == 0) ask();
    }
    /// Checks immediately; call this before work that takes long. @throws MeshInterrupted
    void ask() const {
        if (interrupted_ && interrupted_()) throw MeshInterrupted();
    }

  private:
    static constexpr std::uint32_t pieces_a_question = 1024;

    const std::function<bool()>& interrupted_;
    std::uint32_t pieces_ = 0;
};

}  // namespace crackle
