// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/packing_store.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <optional>
#include <system_error>
#include <utility>

#include "solver/base/system_failure.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/packing/packing_text.hpp"

namespace crackle {
namespace {

/// Removes a file at the end of the scope if the file still exists.
class Removal {
  public:
    explicit Removal(std::filesystem::path file) : file_(std::move(file)) {}
    Removal(const Removal&) = delete;
    Removal& operator=(const Removal&) = delete;
    ~Removal() {
        std::error_code ignored;
        std::filesystem::remove(file_, ignored);
    }

  private:
    std::filesystem::path file_;
};

}  // namespace

Packing PackingStore::get(const ResolvedCase& test, const PackingRequest& request,
                          const std::function<Packing()>& make) {
    const std::string identity = packing_identity(test, files_);
    const std::filesystem::path path = folder_ / (identity + ".json");
    if (identity != last_identity_) {
        last_text_ = is_file(path) ? read_file(path) : "";
        last_identity_ = identity;
    }
    // A damaged packing is made again.
    if (std::optional<Packing> kept = packing_of_text(last_text_, request.material, request.threads))
        return *std::move(kept);
    Packing packing = make();
    last_text_ = packing_text(packing);
    make_folder(folder_);
    // Two processes may make the same packing; each writes the same bytes to a temporary file of its own.
    const std::filesystem::path own = folder_ / fmt::format("{}.{}", identity, ::getpid());
    const Removal removal(own);
    replace_file(own, last_text_);
    std::error_code error;
    std::filesystem::rename(own, path, error);
    if (error) fail_writing(error.value(), fmt::format("{}: cannot be replaced ({})", path.string(), error.message()));
    return packing;
}

}  // namespace crackle
