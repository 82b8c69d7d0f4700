// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/packing_store.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <optional>
#include <system_error>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/packing/packing_text.hpp"

namespace crackle {

Packing PackingStore::get(const TestCase& test, const PackingRequest& request, const std::function<Packing()>& make) {
    const std::string identity = packing_identity(test, files_);
    const std::filesystem::path path = folder_ / (identity + ".json");
    if (identity != last_identity_) {
        last_text_ = is_file(path) ? read_file(path) : "";
        last_identity_ = identity;
    }
    // A damaged one is made again.
    if (std::optional<Packing> kept = packing_of_text(last_text_, request.material, request.threads))
        return *std::move(kept);
    Packing packing = make();
    last_text_ = packing_text(packing);
    make_folder(folder_);
    // Two processes may be making the same one: each under a name of its own, and the same bytes.
    const std::filesystem::path own = folder_ / fmt::format("{}.{}", identity, ::getpid());
    replace_file(own, last_text_);
    std::error_code error;
    std::filesystem::rename(own, path, error);
    if (error) throw OutputError(fmt::format("{}: cannot be replaced ({})", path.string(), error.message()));
    return packing;
}

}  // namespace crackle
