// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/linear_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "solver/base/errors.hpp"
#include "specimens/campaign/crew.hpp"
#include "specimens/campaign/packing_store.hpp"
#include "specimens/loading/prepare.hpp"

namespace crackle {
namespace {

using PlainJson = nlohmann::json;

PlainJson moduli_of_case(TestCase test, PackingStore& packings) {
    test.numerics.threads = 1;  // a worker is one processor's, and a forked process has no others
    std::array<double, linear_figures> found{};
    found.fill(std::nan(""));
    TestHooks hooks;
    hooks.keep_packing = [&](const TestCase& of, const PackingRequest& request, const auto& make) {
        return packings.get(of, request, make);
    };
    const auto look = [&](const World&, const TestSetup&, const Moduli& moduli) {
        found = {moduli.youngs_modulus, moduli.poissons_ratio, moduli.gauge_modulus};
    };
    bond_test(test, hooks, look);
    return PlainJson(found);
}

}  // namespace

std::optional<LinearFigure> linear_figure_of(std::string_view figure) {
    if (figure.ends_with("_pa")) figure.remove_suffix(3);
    if (figure == "youngs_modulus" || figure == "initial_tangent_modulus" || figure == "tangent_modulus_50")
        return LinearFigure::youngs_modulus;
    if (figure == "poissons_ratio" || figure == "initial_poissons_ratio" || figure == "tangent_50_poissons_ratio")
        return LinearFigure::poissons_ratio;
    if (figure == "gauge_modulus") return LinearFigure::gauge_modulus;
    return std::nullopt;
}

bool is_elastic_key(std::string_view key) {
    const std::size_t dot = key.rfind('.');
    const std::string_view name = dot == std::string_view::npos ? key : key.substr(dot + 1);
    return name == "contact_modulus" || name == "stiffness_ratio" || name == "normal_stiffness" ||
           name == "shear_stiffness";
}

std::vector<std::vector<double>> mean_linear_figures(const LinearRequest& request, std::span<const double> values) {
    const Rock& rock = *request.rock;
    // One plan of these values, so that packings get their seeds as those of the tests do.
    Plan plan;
    plan.file = rock.file;
    plan.tests = rock.tests;
    plan.own_seeds = false;
    plan.packings = rock.fit;
    for (const std::size_t test : request.tests) plan.points.push_back({test, rock.settings(values), {}, {}, 1});
    judge_points(plan);
    const std::size_t count = static_cast<std::size_t>(rock.fit) * request.tests.size();
    std::array<double, linear_figures> none{};
    none.fill(std::nan(""));
    std::vector<std::array<double, linear_figures>> found(count, none);
    FileHashes files;
    PackingStore packings(request.packings, files);
    std::size_t next = 0;
    std::string wrong, refused;
    CrewWork crew;
    crew.work = [&](std::size_t piece) {
        const PlanRow row{piece % request.tests.size(),
                          rock.first_seed + static_cast<std::int64_t>(piece / request.tests.size()), Variant::as_asked};
        try {
            return moduli_of_case(plan.test_of(row), packings).dump();
        } catch (const std::exception& error) {
            return PlainJson{{"wrong", fmt::format("seed {}: {}", row.seed, error.what())}}.dump();
        }
    };
    crew.next = [&](std::optional<std::size_t>) { return next < count ? std::optional(next++) : std::nullopt; };
    crew.ended = [&](std::size_t piece, const PieceEnd& end) {
        if (end.how != PieceEnd::How::answered) {
            wrong = fmt::format("the linear solve of seed {} ended its process",
                                rock.first_seed + static_cast<std::int64_t>(piece / request.tests.size()));
            return;
        }
        const PlainJson answer = PlainJson::parse(end.answer);
        if (answer.is_object()) {
            if (refused.empty()) refused = answer["wrong"];
            return;
        }
        for (std::size_t k = 0; k < linear_figures; ++k)
            found[piece][k] = answer[k].is_number() ? answer[k].get<double>() : std::nan("");
    };
    crew.interrupted = [&] { return !wrong.empty() || (request.interrupted && request.interrupted()); };
    const bool complete = run_crew(std::min(request.workers, static_cast<int>(count)), crew);
    if (!wrong.empty()) throw InputError(fmt::format("{}: {}", rock.file.string(), wrong));
    if (!complete) throw TestInterrupted();
    // As for tests: of the packings that have it, where these are at least half.
    std::vector<std::vector<double>> means(request.tests.size(), std::vector<double>(linear_figures, std::nan("")));
    for (std::size_t test = 0; test < request.tests.size(); ++test) {
        for (std::size_t k = 0; k < linear_figures; ++k) {
            double sum = 0.0;
            std::int64_t counted = 0;
            for (std::size_t piece = test; piece < count; piece += request.tests.size()) {
                if (!std::isfinite(found[piece][k])) continue;
                sum += found[piece][k];
                ++counted;
            }
            if (2 * counted >= rock.fit) means[test][k] = sum / static_cast<double>(counted);
        }
        if (std::isnan(means[test][0]) && !refused.empty())
            throw InputError(
                fmt::format("{}: more than half of the packings are refused: {}", rock.file.string(), refused));
    }
    return means;
}

}  // namespace crackle
