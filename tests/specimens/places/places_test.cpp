// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/places/places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "specimens/case/parameters.hpp"

namespace crackle {
namespace {

TEST(Places, NameFileAndLineOfAKeyOfItsTableOrOfTheFile) {
    WrittenPlaces written;
    written.source = "rock.toml";
    written.position = {{"bond", "rock.toml:7"}, {"bond.thick", "other.toml:8"}, {"joint_set[2].p20", "rock.toml:30"}};
    const Places places(std::make_shared<const WrittenPlaces>(written));
    EXPECT_EQ(places.at(CaseKey::bond_thick), "other.toml:8: bond.thick");
    EXPECT_EQ(places.at(CaseKey::bond_law), "rock.toml:7: bond.law");
    EXPECT_EQ(places.at(CaseKey::mesh), "rock.toml: mesh");
    EXPECT_EQ(places.at(CaseKey::joint_set_p20, 1), "rock.toml:30: joint_set[2].p20");
    EXPECT_EQ(places.at(CaseKey::trace, 0), "rock.toml: trace[1]");
    EXPECT_TRUE(places.gives(CaseKey::bond_thick));
    EXPECT_FALSE(places.gives(CaseKey::bond_law));
}

TEST(Places, OfPartsThatWereNotReadAreTheKeysAlone) {
    EXPECT_EQ(Places().at(CaseKey::bond_thick), "bond.thick");
    EXPECT_EQ(Places().at(CaseKey::mineral, 0), "mineral[1]");
    EXPECT_FALSE(Places().gives(CaseKey::bond_thick));
}

TEST(Places, AreThoseOfDeclaredKeysAndTables) {
    for (const std::string& name : names_of<CaseKey>()) {
        const std::size_t dot = name.find('.');
        if (dot == std::string::npos)
            EXPECT_NE(std::ranges::find(case_tables(), name, &TableDescription::name), case_tables().end()) << name;
        else
            EXPECT_NE(find_parameter(name.substr(0, dot), name.substr(dot + 1)), nullptr) << name;
    }
    EXPECT_EQ(name_of(CaseKey::numerics_time_step), std::string("numerics.time_step")) << "as many names as values";
}

}  // namespace
}  // namespace crackle
