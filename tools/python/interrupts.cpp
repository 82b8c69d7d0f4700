// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/python/interrupts.hpp"

#include <unistd.h>

#include <utility>

namespace crackle::python {
namespace {

constexpr std::chrono::milliseconds between_questions{50};

}  // namespace

Interrupts::Interrupts() : process_(::getpid()) {}

bool Interrupts::heard() {
    // The workers of a campaign are forked processes, in which the interpreter must not be used.
    if (over_ || std::this_thread::get_id() != home_ || process_ != ::getpid()) return over_;
    const Clock::time_point now = Clock::now();
    if (now - asked_ < between_questions) return false;
    asked_ = now;
    const pybind11::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) raised(pybind11::error_already_set());
    return over_;
}

void Interrupts::raised(const pybind11::error_already_set& error) {
    if (!error_) error_ = std::make_unique<pybind11::error_already_set>(error);
    over_ = true;
}

void Interrupts::rethrow() {
    if (!error_) return;
    const std::unique_ptr<pybind11::error_already_set> error = std::move(error_);
    throw pybind11::error_already_set(*error);
}

}  // namespace crackle::python
