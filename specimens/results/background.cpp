// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/background.hpp"

#include <system_error>
#include <utility>

namespace crackle {

Background::~Background() {
    {
        const std::lock_guard locked(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void Background::throw_error(std::unique_lock<std::mutex>& locked) {
    if (!error_) return;
    const std::exception_ptr error = std::exchange(error_, nullptr);
    locked.unlock();
    std::rethrow_exception(error);
}

void Background::make_room(std::size_t most_waiting) {
    std::unique_lock locked(mutex_);
    changed_.wait(locked, [&] { return jobs_.size() <= most_waiting; });
    throw_error(locked);
}

void Background::add(std::function<void()> job) {
    std::unique_lock locked(mutex_);
    throw_error(locked);
    if (!thread_.joinable()) {
        try {
            thread_ = std::thread([this] { work(); });
        } catch (const std::system_error&) {  // the limit on this user's threads is reached: run the job in this thread
            job();
            return;
        }
    }
    jobs_.push_back(std::move(job));
    locked.unlock();
    changed_.notify_all();
}

void Background::wait() {
    std::unique_lock locked(mutex_);
    changed_.wait(locked, [&] { return jobs_.empty(); });
    throw_error(locked);
}

void Background::work() {
    std::unique_lock locked(mutex_);
    while (true) {
        changed_.wait(locked, [&] { return ending_ || !jobs_.empty(); });
        if (jobs_.empty()) return;
        const std::function<void()> job = jobs_.front();
        locked.unlock();
        std::exception_ptr thrown;
        try {
            job();
        } catch (...) {  // any exception is passed on to the waiting thread
            thrown = std::current_exception();
        }
        locked.lock();
        if (thrown) {
            error_ = thrown;
            jobs_.clear();
        } else {
            jobs_.pop_front();
        }
        changed_.notify_all();
    }
}

}  // namespace crackle
