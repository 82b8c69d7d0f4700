// SPDX-License-Identifier: GPL-3.0-or-later
// Definition of a kind of test: its keys, its specimen and apparatus, the names of stress and strain, and the failure
// mode of a valid test. Each kind is one object in a file of specimens/kinds, and one row here.
// Tested by tests/specimens/kinds/test_kind_test.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "solver/base/names.hpp"

/// The kinds of test. For each NAME, a file of specimens/kinds defines NAME_kind.
#define CRACKLE_TEST_KINDS(KIND) \
    KIND(compression)            \
    KIND(tension)                \
    KIND(biaxial)                \
    KIND(brazilian)              \
    KIND(bending)                \
    KIND(scb)                    \
    KIND(direct_shear)

namespace crackle {

#define CRACKLE_NAME(name) name,
#define CRACKLE_QUOTED(name) #name,
/// Kind of test, as named in a case.
enum class LoadingKind : std::uint8_t { CRACKLE_TEST_KINDS(CRACKLE_NAME) };
constexpr auto list_names(LoadingKind) { return std::to_array<std::string_view>({CRACKLE_TEST_KINDS(CRACKLE_QUOTED)}); }
#undef CRACKLE_NAME
#undef CRACKLE_QUOTED

struct Apparatus;
struct KindRequest;
struct Shape;

/// A key of the case that only some kinds of test have.
struct KindKey {
    const char* key;
    const char* needed = nullptr;  ///< reason why the kind needs the key; nullptr if the key may be left out
};

/// Names of stress and strain on the axes of diagrams.
struct CurveNames {
    const char *stress = "axial stress", *strain = "axial strain";
};

/// Failure mode expected in a valid test (specimens/measures/verdicts.hpp).
enum class ValidFailure : std::uint8_t { between_platens, splits_disc, from_midspan, along_gap };

/// A kind of test.
struct TestKind {
    CurveNames curve = {};
    bool compression = true;  ///< whether the driving part moves in the negative direction of its axis
    /// Whether the specimen lies between platens, so that stress and strain are those of the rock, and quantities such
    /// as moduli and crack thresholds are defined.
    bool uniaxial = false;
    bool confined = false;  ///< whether a pressure acts on the sides
    /// Whether the test is a direct shear test with a normal force, so that dilation and residual shear stress are
    /// defined.
    bool shear_box = false;
    bool notched = false;  ///< whether the specimen always has a notch
    std::span<const KindKey> keys = {};
    const char* bonded_because = nullptr;  ///< reason why parts must be bonded; nullptr if they may be frictional
    ValidFailure valid_failure = ValidFailure::between_platens;
    const char *driver = "platen", *support = "platen";  ///< names of the driving part and the supports in messages
    /// Returns the shape to be cut out of the packing. Called before the bodies are known.
    Shape (*shape)(const KindRequest&) = nullptr;
    /// Returns the parts that hold and drive the specimen; nullptr for the uniaxial kinds, which have platens.
    Apparatus (*apparatus)(const KindRequest&, const Shape&) = nullptr;

    /// Whether the specimen is pulled apart between platens.
    bool pulls() const { return uniaxial && !compression; }
    /// Whether the specimen is pressed between platens.
    bool presses() const { return uniaxial && compression; }
    /// Whether a pressure or normal force does work on the specimen, in addition to the driving part.
    bool pressed() const { return confined || shear_box; }
    /// Whether a case of this kind may have the key. @param key  "table.key"
    bool has(std::string_view key) const { return std::ranges::find(keys, key, &KindKey::key) != keys.end(); }
};

/// Returns the definition of a kind of test.
const TestKind& test_kind(LoadingKind kind);
/// Names of the kinds for which `is` is true, formatted for messages: "a", "b" or "c".
std::string kinds_with(const std::function<bool(const TestKind&)>& is);

}  // namespace crackle
