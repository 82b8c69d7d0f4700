// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/linear_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "specimens/campaign/crew.hpp"
#include "specimens/campaign/packing_store.hpp"
#include "specimens/campaign/row.hpp"
#include "specimens/loading/prepare.hpp"

namespace crackle {
namespace {

using LinearFigures = std::array<double, linear_figures>;

// First byte of a worker's answer, which states its kind. The moduli, or the reason for a failure, follow as raw bytes,
// because a reason may contain a file name that is not valid UTF-8.
constexpr char solved = 's', refused_case = 'r', unwritten_file = 'u', failed_system = 'f';

LinearFigures moduli_of_case(ResolvedCase test, PackingStore& packings) {
    test.numerics.threads = 1;  // a worker has one processor, and a forked process has no other threads
    LinearFigures found{};
    found.fill(std::nan(""));
    TestHooks hooks;
    hooks.keep_packing = packings.keeping(test);
    const auto look = [&](const World&, const TestSetup&, const Moduli& moduli) {
        found = {moduli.youngs_modulus, moduli.poissons_ratio, moduli.gauge_modulus};
    };
    bond_test(test, hooks, look);
    return found;
}

/// A single plan for all tests, so that packings get the same seeds as in the campaign.
Plan plan_of(const LinearRequest& request, std::span<const double> values) {
    const Rock& rock = *request.rock;
    Plan plan;
    plan.file = rock.file;
    plan.tests = rock.tests;
    plan.own_seeds = false;
    plan.packings = rock.fit;
    for (const std::size_t test : request.tests) plan.points.push_back({test, rock.settings(values), {}, {}, 1});
    judge_points(plan);
    return plan;
}

/// Builds a worker's answer. @param solve  computes the moduli @param said  formats the reason for a failure
std::string answer_of(const auto& solve, const auto& said) {
    const auto answer = [&](char kind, const char* why) { return kind + said(why); };
    try {
        const LinearFigures moduli = solve();
        return solved + std::string(reinterpret_cast<const char*>(moduli.data()), sizeof moduli);
    } catch (const OutputError& error) {
        return answer(unwritten_file, error.what());
    } catch (const UnreadableFile& error) {
        return answer(failed_system, error.what());
    } catch (const InputError& error) {
        return answer(refused_case, error.what());
    } catch (const std::bad_alloc&) {
        return answer(failed_system, no_memory);
    } catch (const std::exception& error) {
        return answer(failed_system, error.what());
    }
}

/// Mean moduli of each test, over the packings that have a value. A mean is NaN if fewer than half of the packings have
/// one. @param found  moduli by packing, then by test @param fit  number of packings
std::vector<std::vector<double>> means_of(const std::vector<LinearFigures>& found, std::size_t tests,
                                          std::int64_t fit) {
    std::vector<std::vector<double>> means(tests, std::vector<double>(linear_figures, std::nan("")));
    for (std::size_t test = 0; test < tests; ++test) {
        for (std::size_t k = 0; k < linear_figures; ++k) {
            double sum = 0.0;
            std::int64_t counted = 0;
            for (std::size_t piece = test; piece < found.size(); piece += tests) {
                if (!std::isfinite(found[piece][k])) continue;
                sum += found[piece][k];
                ++counted;
            }
            if (2 * counted >= fit) means[test][k] = sum / static_cast<double>(counted);
        }
    }
    return means;
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
    return name == "youngs_modulus" || name == "poissons_ratio" || name == "contact_modulus" ||
           name == "stiffness_ratio" || name == "normal_stiffness" || name == "shear_stiffness";
}

std::vector<std::vector<double>> mean_linear_figures(const LinearRequest& request, std::span<const double> values) {
    const Rock& rock = *request.rock;
    const Plan plan = plan_of(request, values);
    const std::size_t count = static_cast<std::size_t>(rock.fit) * request.tests.size();
    LinearFigures none{};
    none.fill(std::nan(""));
    std::vector<LinearFigures> found(count, none);
    FileHashes files;
    PackingStore packings(request.packings, files);
    std::size_t next = 0;
    std::string failed, refused, unwritten;
    const auto row_of = [&](std::size_t piece) {
        return PlanRow{piece % request.tests.size(),
                       rock.first_seed + static_cast<std::int64_t>(piece / request.tests.size()), Variant::as_asked};
    };
    const auto told = [&](const PlanRow& row, const std::string& why) {
        return fmt::format("{}, seed {}: {}", rock.tests[request.tests[row.point]].name, row.seed, why);
    };
    CrewWork crew;
    crew.work = [&](std::size_t piece) {
        const PlanRow row = row_of(piece);
        return answer_of([&] { return moduli_of_case(plan.test_of(row), packings); },
                         [&](const char* why) { return told(row, why); });
    };
    crew.next = [&](std::optional<std::size_t>) { return next < count ? std::optional(next++) : std::nullopt; };
    crew.ended = [&](std::size_t piece, const PieceEnd& end) {
        if (end.how != PieceEnd::How::answered) {
            failed = told(row_of(piece), end.code == worker_without_memory ? no_memory : spoken_end(end));
            return;
        }
        const char kind = end.answer.front();
        if (kind == solved) {
            std::memcpy(found[piece].data(), end.answer.data() + 1, sizeof(LinearFigures));
            return;
        }
        std::string& why = kind == failed_system ? failed : kind == refused_case ? refused : unwritten;
        if (why.empty()) why = end.answer.substr(1);
    };
    crew.interrupted = [&] {
        return !failed.empty() || !unwritten.empty() || (request.interrupted && request.interrupted());
    };
    const bool complete = run_crew(std::min(request.workers, static_cast<int>(count)), crew);
    if (!unwritten.empty()) throw OutputError(unwritten + "; run the same command again to resume");
    if (!failed.empty())
        throw SystemFailure(
            fmt::format("{}: a linear solve failed because of the system: {}; run the same command again to resume",
                        rock.file.string(), failed));
    if (!complete) throw TestInterrupted();
    std::vector<std::vector<double>> means = means_of(found, request.tests.size(), rock.fit);
    const bool refuses = std::ranges::any_of(means, [](const auto& of_test) { return std::isnan(of_test[0]); });
    if (refuses && !refused.empty())
        throw InputError(fmt::format("{}: more than half of the packings were refused, for example {}",
                                     rock.file.string(), refused));
    return means;
}

}  // namespace crackle
