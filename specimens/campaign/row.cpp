// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/row.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <string_view>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/loading/expected_run.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/run.hpp"
#include "specimens/observers/curve.hpp"
#include "specimens/results/make_summary.hpp"
#include "specimens/results/sha256.hpp"

namespace crackle {
namespace {

double processor_seconds() {
    struct rusage usage = {};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Adds the figures of each visited member of a summary to a list.
struct FigureLister {
    Figures& figures;
    std::string prefix = "";

    template <class T>
    void operator()(const std::string& name, const T& figure, const FigureRow& /*row*/) const {
        if constexpr (HasFields<T>) {
            T::fields(figure, *this);
        } else if constexpr (!std::derived_from<T, Aside<typename T::value_type>>) {
            if (figure) add(prefix + name, *figure);
            if constexpr (std::same_as<T, Stress>) (*this)(name + converted_suffix, figure.converted, {});
        }
    }
    template <class T>
    void add(const std::string& name, const T& value) const {
        if constexpr (HasFields<T>)
            T::fields(value, FigureLister{figures, name + '.'});
        else if constexpr (HasNames<T>)
            figures.emplace_back(name, name_of(value));
        else if constexpr (std::is_arithmetic_v<T>)
            figures.emplace_back(name, static_cast<double>(value));
        else
            figures.emplace_back(name, value);
    }
    /// Adds the figures of each element, such as "joints[2].length". Lists of plain numbers are left out.
    template <class T>
    void add(const std::string& name, const std::vector<T>& list) const {
        if constexpr (HasFields<T>)
            for (std::size_t k = 0; k < list.size(); ++k) add(fmt::format("{}[{}]", name, k + 1), list[k]);
    }
    template <class T>
    void add(const std::string& name, const Table<T>& table) const {
        for (const auto& [key, value] : table) add(fmt::format("{}.{}", name, key), value);
    }
};

std::string curve_text(const VirtualTest& test) {
    std::string text = curve_header(test.setup.apparatus.pressed());
    for (const CurveRow& row : written_rows(test)) text += curve_line(row, test.setup.apparatus.pressed());
    return text;
}

Summary loaded_in_memory(const ResolvedCase& description, const RowPlace& place, const TestHooks& hooks,
                         std::string* curve) {
    VirtualTest test = prepare_test(description, hooks);
    const RunEstimate run = expected_run(test, description.loading.max_axial_strain, roughly_steps_per_second(test));
    if (!place.endless) refuse_endless(test, run);
    load_specimen(test, hooks);
    if (test.state.ended_by.empty()) throw TestInterrupted();
    if (curve != nullptr) *curve = curve_text(test);
    return make_summary(test.description, test.setup, test.state, test.world, {});
}

Summary loaded_with_files(const ResolvedCase& description, const std::filesystem::path& folder, const RowPlace& place,
                          const TestHooks& hooks) {
    TestOptions options;
    options.folder = folder;
    options.force = options.begins_again = true;  // overwrites the remains of a killed run
    options.most_threads = 1;
    options.endless = place.endless;
    options.command = "crackle campaign";
    const TestOutcome outcome = run_test(description, options, hooks);
    if (outcome.interrupted) throw TestInterrupted();
    return outcome.summary;
}

}  // namespace

RowKind kind_of_row(std::string_view state) {
    if (state == row_done) return RowKind::result;
    return state == row_failed || state == row_crashed ? RowKind::failure : RowKind::verdict;
}

std::string spoken_wrong(std::int64_t gone_wrong, std::int64_t failures) {
    return fmt::format(
        "{} gone wrong{}", gone_wrong,
        failures > 0 ? fmt::format(", {} of them because of a system error; run the same command again to repeat {}",
                                   failures, failures > 1 ? "them" : "it")
                     : "");
}

Figures figures_of(const Summary& summary) {
    Figures figures;
    Summary::fields(summary, FigureLister{figures});
    return figures;
}

RowResult run_row(const ResolvedCase& test, const RowNames& names, Keep keep, const RowPlace& place,
                  PackingStore& packings, const std::function<bool()>& interrupted) {
    const auto begun = std::chrono::steady_clock::now();
    const double before = processor_seconds();
    RowResult result;
    result.identity = names.identity;
    TestHooks hooks;
    hooks.interrupted = interrupted;
    hooks.keep_packing = packings.keeping(test);
    ResolvedCase description = test;
    description.numerics.threads = 1;
    const auto went_wrong = [&](const char* state, int exit, const std::string& message) {
        result.state = state;
        result.exit = exit;
        result.message = message;
    };
    try {
        std::string curve;
        const Summary summary =
            keep == Keep::all ? loaded_with_files(description, place.folder / "tests" / names.kept, place, hooks)
                              : loaded_in_memory(description, place, hooks, keep == Keep::curves ? &curve : nullptr);
        if (keep == Keep::curves) {
            make_folder(place.folder / "curves");
            replace_file(place.folder / "curves" / (names.kept + ".csv"), curve);
            result.curve_sha256 = sha256(curve);
        }
        if (keep == Keep::all)
            result.summary_sha256 = sha256(read_file(place.folder / "tests" / names.kept / "summary.json"));
        result.figures = figures_of(summary);
        result.notices = summary.notices.value_or(std::vector<std::string>());
        result.state = row_done;
    } catch (const OutputError&) {
        throw;
    } catch (const TestInterrupted&) {
        throw;
    } catch (const UnreadableFile& error) {  // the file could be read when the plan was checked
        went_wrong(row_failed, 4, error.what());
    } catch (const InputError& error) {
        went_wrong(row_refused, 2, error.what());
    } catch (const UnstableRun& error) {
        went_wrong(row_unstable, 3, error.what());
    } catch (const std::bad_alloc&) {
        went_wrong(row_failed, 4, no_memory);
    } catch (const std::exception& error) {
        went_wrong(row_failed, 4, error.what());
    }
    result.processor_seconds = processor_seconds() - before;
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    return result;
}

}  // namespace crackle
