// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces functions of the C library through LD_PRELOAD. Each call can fail according to the plan (plan.cpp), and is
// recorded in the trace (trace.hpp) once it has been executed. Calls by libstdc++'s streams, by std::filesystem and by
// the program itself are replaced. Calls inside the C library are not seen, such as close() in fclose() or mmap() in
// malloc(). Therefore fclose() counts as a close, and large allocations are a separate kind (replaced_memory.cpp).
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <string>

#include "tests/faults/plan.hpp"
#include "tests/faults/trace.hpp"

namespace crackle::faults {
namespace {

// The original function in the C library.
#define CRACKLE_REAL(name) static const auto real = reinterpret_cast<decltype(&::name)>(dlsym(RTLD_NEXT, #name))

/// The third argument of open() exists only with these flags.
mode_t mode_behind(int flags, va_list rest) {
    const bool makes = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
    return makes ? static_cast<mode_t>(va_arg(rest, unsigned)) : mode_t{0};
}

bool exists(const Path& path) { return syscall(SYS_access, path.text, F_OK) == 0; }

/// Opens a file by calling `real()`. On failure, returns the value by which the function reports failure.
template <class Result, class Real>
Result opened(const Path& path, int flags, Result failure, Real real) {
    if (fails(Call::open, path)) return failure;
    const Recorded record;
    const bool was_there = record.wanted() && exists(path);
    const Result result = real();
    if (!record.wanted() || result == failure) return result;
    if (!was_there && (flags & O_CREAT) != 0) record.add("create", path);
    if (was_there && (flags & O_TRUNC) != 0) record.add("truncate", path, 0);
    return result;
}

int flags_of(const char* mode) { return *mode == 'w' ? O_CREAT | O_TRUNC : *mode == 'a' ? O_CREAT : 0; }

/// Writes by calling `real()`; `bytes` are the data for the file's current position.
template <class Real>
ssize_t written(int file, std::string_view bytes, Real real) {
    const Path path = path_of(file);
    if (fails(Call::write, path)) return -1;
    const Recorded record;
    const ssize_t count = real();
    if (record.wanted() && count > 0) {
        const long end = syscall(SYS_lseek, file, 0L, SEEK_CUR);
        record.add("write", path, end - count, bytes.substr(0, static_cast<std::size_t>(count)));
    }
    return count;
}

/// Executes a call that returns 0 on success.
template <class Real>
int done(Call call, const char* kind, const Path& path, Real real, long offset = 0, std::string_view data = {}) {
    if (fails(call, path)) return -1;
    const Recorded record;
    const int result = real();
    if (result == 0) record.add(kind, path, offset, data);
    return result;
}

template <class Real>
int renamed(const Path& from, const Path& to, Real real) {
    return done(Call::rename, "rename", from, real, 0, to.text);
}

}  // namespace
}  // namespace crackle::faults

using namespace crackle::faults;

extern "C" {

int open(const char* name, int flags, ...) {
    CRACKLE_REAL(open);
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = mode_behind(flags, rest);
    va_end(rest);
    return opened(path_at(AT_FDCWD, name), flags, -1, [&] { return real(name, flags, mode); });
}

int open64(const char* name, int flags, ...) {
    CRACKLE_REAL(open64);
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = mode_behind(flags, rest);
    va_end(rest);
    return opened(path_at(AT_FDCWD, name), flags, -1, [&] { return real(name, flags, mode); });
}

int openat(int folder, const char* name, int flags, ...) {
    CRACKLE_REAL(openat);
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = mode_behind(flags, rest);
    va_end(rest);
    return opened(path_at(folder, name), flags, -1, [&] { return real(folder, name, flags, mode); });
}

int openat64(int folder, const char* name, int flags, ...) {
    CRACKLE_REAL(openat64);
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = mode_behind(flags, rest);
    va_end(rest);
    return opened(path_at(folder, name), flags, -1, [&] { return real(folder, name, flags, mode); });
}

int creat(const char* name, mode_t mode) {
    CRACKLE_REAL(creat);
    return opened(path_at(AT_FDCWD, name), O_CREAT | O_TRUNC, -1, [&] { return real(name, mode); });
}

FILE* fopen(const char* name, const char* mode) {
    CRACKLE_REAL(fopen);
    return opened<FILE*>(path_at(AT_FDCWD, name), flags_of(mode), nullptr, [&] { return real(name, mode); });
}

FILE* fopen64(const char* name, const char* mode) {
    CRACKLE_REAL(fopen64);
    return opened<FILE*>(path_at(AT_FDCWD, name), flags_of(mode), nullptr, [&] { return real(name, mode); });
}

ssize_t read(int file, void* bytes, size_t count) {
    CRACKLE_REAL(read);
    return fails(Call::read, file) ? -1 : real(file, bytes, count);
}

ssize_t readv(int file, const iovec* parts, int count) {
    CRACKLE_REAL(readv);
    return fails(Call::read, file) ? -1 : real(file, parts, count);
}

ssize_t pread(int file, void* bytes, size_t count, off_t at) {
    CRACKLE_REAL(pread);
    return fails(Call::read, file) ? -1 : real(file, bytes, count, at);
}

ssize_t write(int file, const void* bytes, size_t count) {
    CRACKLE_REAL(write);
    return written(file, {static_cast<const char*>(bytes), count}, [&] { return real(file, bytes, count); });
}

ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
    CRACKLE_REAL(pwrite);
    const Path path = path_of(file);
    if (fails(Call::write, path)) return -1;
    const Recorded record;
    const ssize_t written = real(file, bytes, count, at);
    if (record.wanted() && written > 0)
        record.add("write", path, at, {static_cast<const char*>(bytes), static_cast<std::size_t>(written)});
    return written;
}

ssize_t writev(int file, const iovec* parts, int count) {
    CRACKLE_REAL(writev);
    std::string bytes;
    if (Recorded().wanted())
        for (int k = 0; k < count; ++k) bytes.append(static_cast<const char*>(parts[k].iov_base), parts[k].iov_len);
    return written(file, bytes, [&] { return real(file, parts, count); });
}

int fsync(int file) {
    CRACKLE_REAL(fsync);
    return done(Call::fsync, "fsync", path_of(file), [&] { return real(file); });
}

int fdatasync(int file) {
    CRACKLE_REAL(fdatasync);
    return done(Call::fsync, "fsync", path_of(file), [&] { return real(file); });
}

int syncfs(int file) noexcept {
    CRACKLE_REAL(syncfs);
    return done(Call::fsync, "syncfs", path_of(file), [&] { return real(file); });
}

int rename(const char* from, const char* to) noexcept {
    CRACKLE_REAL(rename);
    return renamed(path_at(AT_FDCWD, from), path_at(AT_FDCWD, to), [&] { return real(from, to); });
}

int renameat(int folder, const char* from, int other, const char* to) noexcept {
    CRACKLE_REAL(renameat);
    return renamed(path_at(folder, from), path_at(other, to), [&] { return real(folder, from, other, to); });
}

int renameat2(int folder, const char* from, int other, const char* to, unsigned flags) noexcept {
    CRACKLE_REAL(renameat2);
    return renamed(path_at(folder, from), path_at(other, to), [&] { return real(folder, from, other, to, flags); });
}

int unlink(const char* name) noexcept {
    CRACKLE_REAL(unlink);
    return done(Call::unlink, "unlink", path_at(AT_FDCWD, name), [&] { return real(name); });
}

int unlinkat(int folder, const char* name, int flags) noexcept {
    CRACKLE_REAL(unlinkat);
    return done(Call::unlink, "unlink", path_at(folder, name), [&] { return real(folder, name, flags); });
}

int remove(const char* name) noexcept {
    CRACKLE_REAL(remove);
    return done(Call::unlink, "unlink", path_at(AT_FDCWD, name), [&] { return real(name); });
}

int rmdir(const char* name) noexcept {
    CRACKLE_REAL(rmdir);
    return done(Call::unlink, "unlink", path_at(AT_FDCWD, name), [&] { return real(name); });
}

int mkdir(const char* name, mode_t mode) noexcept {
    CRACKLE_REAL(mkdir);
    return done(Call::mkdir, "mkdir", path_at(AT_FDCWD, name), [&] { return real(name, mode); });
}

int mkdirat(int folder, const char* name, mode_t mode) noexcept {
    CRACKLE_REAL(mkdirat);
    return done(Call::mkdir, "mkdir", path_at(folder, name), [&] { return real(folder, name, mode); });
}

int truncate(const char* name, off_t length) noexcept {
    CRACKLE_REAL(truncate);
    return done(
        Call::truncate, "truncate", path_at(AT_FDCWD, name), [&] { return real(name, length); }, length);
}

int ftruncate(int file, off_t length) noexcept {
    CRACKLE_REAL(ftruncate);
    return done(
        Call::truncate, "truncate", path_of(file), [&] { return real(file, length); }, length);
}

void* mmap(void* where, size_t length, int protection, int flags, int file, off_t at) noexcept {
    CRACKLE_REAL(mmap);
    return file >= 0 && fails(Call::mmap, file) ? MAP_FAILED : real(where, length, protection, flags, file, at);
}

int close(int file) {
    CRACKLE_REAL(close);
    const bool wrong = fails(Call::close, file);
    const int reason = errno;
    const int result = real(file);  // Linux closes the file even if it reports an error
    if (!wrong) return result;
    errno = reason;
    return -1;
}

int fclose(FILE* file) {
    CRACKLE_REAL(fclose);
    const bool wrong = fails(Call::close, fileno(file));
    const int reason = errno;
    const int result = real(file);
    if (!wrong) return result;
    errno = reason;
    return EOF;
}

DIR* opendir(const char* name) {
    CRACKLE_REAL(opendir);
    return fails(Call::opendir, name) ? nullptr : real(name);
}

DIR* fdopendir(int folder) {
    CRACKLE_REAL(fdopendir);
    return fails(Call::opendir, folder) ? nullptr : real(folder);
}

dirent* readdir(DIR* folder) {
    CRACKLE_REAL(readdir);
    return fails(Call::readdir, dirfd(folder)) ? nullptr : real(folder);
}

int stat(const char* name, struct stat* found) noexcept {
    CRACKLE_REAL(stat);
    return fails(Call::stat, name) ? -1 : real(name, found);
}

int lstat(const char* name, struct stat* found) noexcept {
    CRACKLE_REAL(lstat);
    return fails(Call::stat, name) ? -1 : real(name, found);
}

int fstat(int file, struct stat* found) noexcept {
    CRACKLE_REAL(fstat);
    return fails(Call::stat, file) ? -1 : real(file, found);
}

int fstatat(int folder, const char* name, struct stat* found, int flags) noexcept {
    CRACKLE_REAL(fstatat);
    return fails(Call::stat, path_at(folder, name)) ? -1 : real(folder, name, found, flags);
}

// Names of the same functions for large files, which do not differ here.
ssize_t pread64(int file, void* bytes, size_t count, off64_t at) { return pread(file, bytes, count, at); }
ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t at) { return pwrite(file, bytes, count, at); }
int truncate64(const char* name, off64_t length) noexcept { return truncate(name, length); }
int ftruncate64(int file, off64_t length) noexcept { return ftruncate(file, length); }
void* mmap64(void* where, size_t length, int protection, int flags, int file, off64_t at) noexcept {
    return mmap(where, length, protection, flags, file, at);
}
dirent64* readdir64(DIR* folder) {
    CRACKLE_REAL(readdir64);
    return fails(Call::readdir, dirfd(folder)) ? nullptr : real(folder);
}
int stat64(const char* name, struct stat64* found) noexcept {
    CRACKLE_REAL(stat64);
    return fails(Call::stat, name) ? -1 : real(name, found);
}
int lstat64(const char* name, struct stat64* found) noexcept {
    CRACKLE_REAL(lstat64);
    return fails(Call::stat, name) ? -1 : real(name, found);
}
int fstat64(int file, struct stat64* found) noexcept {
    CRACKLE_REAL(fstat64);
    return fails(Call::stat, file) ? -1 : real(file, found);
}
int fstatat64(int folder, const char* name, struct stat64* found, int flags) noexcept {
    CRACKLE_REAL(fstatat64);
    return fails(Call::stat, path_at(folder, name)) ? -1 : real(folder, name, found, flags);
}

int flock(int file, int operation) noexcept {
    CRACKLE_REAL(flock);
    return fails(Call::flock, file) ? -1 : real(file, operation);
}

pid_t fork() noexcept {
    CRACKLE_REAL(fork);
    if (!crackle::faults::fork_fails()) return real();
    errno = EAGAIN;
    return -1;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*begin)(void*), void* with) {
    CRACKLE_REAL(pthread_create);
    return crackle::faults::thread_fails() ? EAGAIN : real(thread, attributes, begin, with);
}

}  // extern "C"
