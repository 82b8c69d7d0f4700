// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/crew.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

namespace crackle {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double longest_wait = 0.1;  // s; longest interval between two polls for an interrupt

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

bool send_all(int to, const void* bytes, std::size_t size) {
    const char* at = static_cast<const char*>(bytes);
    while (size > 0) {
        const ssize_t sent = ::send(to, at, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        at += sent;
        size -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool receive_all(int from, void* bytes, std::size_t size) {
    char* at = static_cast<char*>(bytes);
    while (size > 0) {
        const ssize_t got = ::recv(from, at, size, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        at += got;
        size -= static_cast<std::size_t>(got);
    }
    return true;
}

/// Closes all file descriptors of a worker except its socket `line`. Otherwise, a worker would keep inherited locks and
/// the sockets of other workers open after their own processes have ended.
void keep_only(int line) {
    constexpr unsigned first = STDERR_FILENO + 1;
    const auto own = static_cast<unsigned>(line);
    if (own > first) ::close_range(first, own - 1, 0);
    ::close_range(own + 1, ~0U, 0);
}

constexpr int failed_worker = 70;  // sysexits.h: internal software error

/// Main loop of a worker: processes work items until the parent closes the socket.
[[noreturn]] void serve(int line, const CrewWork& crew) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    // Signals to the whole process group (Ctrl-C, scancel) are left to the parent, which decides when the workers stop;
    // a running test must not be reported as killed.
    for (const int signal : {SIGINT, SIGHUP, SIGTERM}) std::signal(signal, SIG_IGN);
    try {
        std::uint64_t piece = 0;
        while (receive_all(line, &piece, sizeof piece)) {
            const std::string answer = crew.work(static_cast<std::size_t>(piece));
            const std::uint64_t size = answer.size();
            if (!send_all(line, &size, sizeof size) || !send_all(line, answer.data(), answer.size())) break;
        }
    } catch (const std::bad_alloc&) {
        std::_Exit(worker_without_memory);
    } catch (...) {
        // The parent's stack frames must not be unwound here. The work item is reported as failed, with this exit code.
        std::_Exit(failed_worker);
    }
    std::_Exit(0);
}

class Worker {
  public:
    explicit Worker(const CrewWork& crew) {
        int lines[2];
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, lines) != 0)
            throw std::system_error(errno, std::generic_category(), "a worker's line");
        process_ = ::fork();
        if (process_ < 0) {
            const int reason = errno;
            ::close(lines[0]);
            ::close(lines[1]);
            throw std::system_error(reason, std::generic_category(), "a worker's process");
        }
        if (process_ == 0) {
            keep_only(lines[1]);
            serve(lines[1], crew);
        }
        ::close(lines[1]);
        line_ = lines[0];
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker() {
        if (process_ < 0) return;
        ::kill(process_, SIGKILL);
        static_cast<void>(end());
    }

    int line() const { return line_; }
    bool at_work() const { return piece_.has_value(); }
    std::size_t piece() const { return *piece_; }
    std::optional<std::size_t> before() const { return before_; }
    double seconds() const { return seconds_since(begun_); }

    /// Sends a work item to the worker. @return false if the worker's process has ended in the meantime
    bool give(std::size_t piece) {
        piece_ = piece;
        begun_ = Clock::now();
        const std::uint64_t number = piece;
        return send_all(line_, &number, sizeof number);
    }
    std::optional<std::string> answer() {
        std::uint64_t size = 0;
        if (!receive_all(line_, &size, sizeof size)) return std::nullopt;
        std::string text(static_cast<std::size_t>(size), '\0');
        if (!receive_all(line_, text.data(), text.size())) return std::nullopt;
        before_ = std::exchange(piece_, std::nullopt);
        return text;
    }
    void kill() const { ::kill(process_, SIGKILL); }
    /// Waits until the process ends. @return status of waitpid()
    int end() {
        int status = 0;
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        ::close(line_);
        process_ = line_ = -1;
        return status;
    }

  private:
    int line_ = -1;
    pid_t process_ = -1;
    std::optional<std::size_t> piece_, before_;
    Clock::time_point begun_;
};

class Crew {
  public:
    Crew(int workers, const CrewWork& crew) : crew_(crew), workers_(static_cast<std::size_t>(workers)) {
        for (auto& worker : workers_) worker = std::make_unique<Worker>(crew_);
    }

    bool run() {
        while (true) {
            if (crew_.interrupted && crew_.interrupted()) return false;
            for (auto& worker : workers_) give(worker);
            if (std::none_of(workers_.begin(), workers_.end(), [](const auto& worker) { return worker->at_work(); }))
                return true;
            wait();
        }
    }

  private:
    /// Gives an idle worker the next work item, if there is one. Replaces a worker whose process has ended.
    void give(std::unique_ptr<Worker>& worker) {
        while (!worker->at_work()) {
            const std::optional<std::size_t> piece = crew_.next(worker->before());
            if (!piece) return;
            if (!worker->give(*piece)) lose(worker);
        }
    }

    void wait() {
        std::vector<pollfd> lines;
        lines.reserve(workers_.size());
        for (const auto& worker : workers_) lines.push_back({worker->at_work() ? worker->line() : -1, POLLIN, 0});
        if (::poll(lines.data(), lines.size(), patience()) < 0) {
            if (errno == EINTR) return;
            throw std::system_error(errno, std::generic_category(), "waiting for workers");
        }
        for (std::size_t k = 0; k < workers_.size(); ++k) {
            if (lines[k].revents != 0)
                take_answer(workers_[k]);
            else if (workers_[k]->at_work() && crew_.time_limit > 0.0 && workers_[k]->seconds() > crew_.time_limit)
                time_out(workers_[k]);
        }
    }

    /// Longest time to wait for an answer, in milliseconds.
    int patience() const {
        double seconds = longest_wait;
        for (const auto& worker : workers_)
            if (worker->at_work() && crew_.time_limit > 0.0)
                seconds = std::clamp(crew_.time_limit - worker->seconds(), 0.0, seconds);
        return static_cast<int>(std::ceil(1e3 * seconds));
    }

    void take_answer(std::unique_ptr<Worker>& worker) {
        const std::size_t piece = worker->piece();
        PieceEnd end;
        end.seconds = worker->seconds();
        std::optional<std::string> answer = worker->answer();
        if (!answer) {
            lose(worker);
            return;
        }
        end.answer = *std::move(answer);
        crew_.ended(piece, end);
    }

    void time_out(std::unique_ptr<Worker>& worker) {
        const PieceEnd end{PieceEnd::How::timed_out, "", SIGKILL, worker->seconds()};
        const std::size_t piece = worker->piece();
        worker->kill();
        worker->end();
        worker = std::make_unique<Worker>(crew_);
        crew_.ended(piece, end);
    }

    /// Reports the work item of a worker whose process has ended as failed, and replaces the worker.
    void lose(std::unique_ptr<Worker>& worker) {
        const std::size_t piece = worker->piece();
        PieceEnd end;
        end.seconds = worker->seconds();
        const int status = worker->end();
        end.how = WIFSIGNALED(status) ? PieceEnd::How::killed : PieceEnd::How::ended;
        end.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
        worker = std::make_unique<Worker>(crew_);
        crew_.ended(piece, end);
    }

    const CrewWork& crew_;
    std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace

std::string spoken_end(const PieceEnd& end) {
    if (end.how == PieceEnd::How::ended)
        return fmt::format("its process exited with code {} and without a result", end.code);
    return fmt::format("its process was ended by signal {} ({})", end.code, ::strsignal(end.code));
}

bool run_crew(int workers, const CrewWork& crew) { return Crew(workers, crew).run(); }

}  // namespace crackle
