// SPDX-License-Identifier: GPL-3.0-or-later
// Files that a campaign keeps of its tests, in curves/ and tests/ next to the ledger. They are found by identity and
// checked against the hashes in the ledger.
// Tested by tests/specimens/campaign/kept_tests_test.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "specimens/campaign/ledger.hpp"
#include "specimens/campaign/plan.hpp"

namespace crackle {

/// Base name of a row's files, for example "confined-pressure=10000000-packing3-1b6f7a6a471c". A point with many axes
/// is named by its one-based number.
std::string kept_name(const Plan& plan, const PlanRow& row, const std::string& identity);

/// Index of the files in curves/ and tests/ at the time of construction. Files are found by identity, even if the test
/// was renamed in the plan since. Earlier versions named files by the identity alone.
class KeptTests {
  public:
    /// @param hashes  hashes in the ledger (CampaignLedger::kept_hashes()); without a hash, a test's files are read
    /// without a check
    explicit KeptTests(const std::filesystem::path& folder, std::map<std::string, KeptHashes> hashes = {});

    /// Base name of a test's files; empty if there are no files.
    std::optional<std::string> name(const std::string& identity) const;
    /// File with a test's curve, in curves/ or in the test's folder.
    std::optional<std::filesystem::path> curve(const std::string& identity) const;
    /// Folder of a test's files; empty unless all its files were kept.
    std::optional<std::filesystem::path> folder(const std::string& identity) const;

    /// File of a curve, and its contents.
    struct Curve {
        std::filesystem::path file;
        std::string text;
    };
    /// The curve of a finished test; empty if no curve was kept.
    /// @throws InputError if the file is not as the test wrote it; the message names the file and how to restore it
    std::optional<Curve> read_curve(const std::string& identity) const;
    /// Checks whether all files that should be kept of a finished test exist and are unchanged.
    /// @return description of what is missing or changed; empty if nothing is
    std::string fault_of(const std::string& identity, Keep keep) const;

  private:
    const KeptHashes* hashes_of(const std::string& identity) const;
    std::optional<Curve> curve_alone(const std::string& identity) const;
    std::optional<Curve> curve_in_folder(const std::string& identity) const;
    void require_whole_folder(const std::filesystem::path& folder, const std::string& identity) const;

    std::map<std::string, std::filesystem::path> curves_, folders_;  // paths by leading digits of the identity
    std::map<std::string, KeptHashes> hashes_;
};

}  // namespace crackle
