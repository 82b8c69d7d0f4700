// SPDX-License-Identifier: GPL-3.0-or-later
// rock.toml of a calibration, the case.toml of its tests, and a measured curve.csv.

#include "specimens/calibration/rock.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::rock(std::string_view bytes) {
    const auto [text, test, curve] = files_of<3>(bytes);
    write_file("case.toml", test);
    write_file("curve.csv", curve);
    const Rock rock = read_rock(write_file("rock.toml", text));
    std::vector<double> start;
    for (const FreeKey& free : rock.free) start.push_back(free.start);
    rock.case_of(0, start);
}
