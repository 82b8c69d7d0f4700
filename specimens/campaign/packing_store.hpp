// SPDX-License-Identifier: GPL-3.0-or-later
// Packings of a campaign, each made once and shared by all tests that start from it.
// Tested by tests/specimens/campaign/campaign_test.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "specimens/campaign/identity.hpp"
#include "specimens/packing/packing.hpp"

namespace crackle {

class PackingStore {
  public:
    /// @param folder made when there is a packing to keep
    PackingStore(std::filesystem::path folder, FileHashes& files) : folder_(std::move(folder)), files_(files) {}

    /// The packing of a case, from the store or made now. Same bits either way. @throws OutputError
    Packing get(const TestCase& test, const PackingRequest& request, const std::function<Packing()>& make);

  private:
    std::filesystem::path folder_;
    FileHashes& files_;
    std::string last_identity_, last_text_;  // of the last one: tests of one packing follow each other
};

}  // namespace crackle
