// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps the packings of a campaign. Each is made only once and shared by all tests that start from it.
// Tested by tests/specimens/campaign/campaign_test.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "specimens/campaign/identity.hpp"
#include "specimens/packing/packing.hpp"

namespace crackle {

/// Folder with the packings of a campaign.
class PackingStore {
  public:
    /// @param folder  folder that is created when the first packing is stored
    PackingStore(std::filesystem::path folder, FileHashes& files) : folder_(std::move(folder)), files_(files) {}

    /// The packing for a case, read from the store or newly made; both are identical bit by bit. @throws OutputError
    Packing get(const ResolvedCase& test, const PackingRequest& request, const std::function<Packing()>& make);
    /// Returns a function that calls get() for the given case; it serves as a hook of the case's test. The store and
    /// the case must outlive this function.
    auto keeping(const ResolvedCase& test) {
        return [this, &test](const PackingRequest& request, const std::function<Packing()>& make) {
            return get(test, request, make);
        };
    }

  private:
    std::filesystem::path folder_;
    FileHashes& files_;
    std::string last_identity_, last_text_;  // cached for the last packing, because consecutive tests often share one
};

}  // namespace crackle
