// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/summary/summary_file.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "solver/base/errors.hpp"
#include "solver/base/names.hpp"
#include "solver/files/read_file.hpp"

namespace crackle {
namespace {

using Json = nlohmann::ordered_json;

/// Writes the visited members to a JSON object.
struct Writer {
    Json& table;

    template <class T>
    void operator()(const std::string& name, const T& figure, const FigureRow& /*row*/ = {}) const {
        if constexpr (HasFields<T>)
            T::fields(figure, *this);
        else if (figure.stated())
            table[name] = figure ? written(*figure) : Json(nullptr);
        if constexpr (std::same_as<T, Stress>) (*this)(name + converted_suffix, figure.converted);
    }

    template <class T>
    static Json written(const std::vector<T>& values) {
        Json list = Json::array();
        for (const T& value : values) list.push_back(written(value));
        return list;
    }
    template <class T>
    static Json written(const Table<T>& values) {
        Json table = Json::object();
        for (const auto& [name, value] : values) table[name] = written(value);
        return table;
    }
    template <class T>
    static Json written(const T& value) {
        if constexpr (HasFields<T>) {
            Json table = Json::object();
            T::fields(value, Writer{table});
            return table;
        } else if constexpr (HasNames<T>) {
            return name_of(value);
        } else {
            return value;
        }
    }
};

/// Reads the visited members from a JSON object.
struct Reader {
    const Json& table;

    template <class T>
    void operator()(const std::string& name, T& figure, const FigureRow& /*row*/ = {}) const {
        if constexpr (HasFields<T>) {
            T::fields(figure, *this);
        } else if (const auto found = table.find(name); found != table.end()) {
            typename T::value_type value{};
            figure = read(*found, value) ? std::optional(std::move(value)) : std::nullopt;
        }
        if constexpr (std::same_as<T, Stress>) (*this)(name + converted_suffix, figure.converted);
    }

    /// Returns false if the JSON value has another type.
    template <class T>
    static bool read(const Json& json, T& value) {
        if constexpr (HasFields<T>) {
            if (json.is_object()) T::fields(value, Reader{json});
            return json.is_object();
        } else if constexpr (HasNames<T>) {
            const auto known = from_name<T>(json.is_string() ? json.get<std::string>() : "");
            value = known.value_or(T{});
            return known.has_value();
        } else {
            const bool right = std::same_as<T, bool>          ? json.is_boolean()
                               : std::same_as<T, std::string> ? json.is_string()
                               : std::integral<T>             ? json.is_number_integer()
                                                              : json.is_number();
            if (right) value = json.get<T>();
            if constexpr (std::floating_point<T>)
                if (!right) value = std::numeric_limits<T>::quiet_NaN();
            return right;
        }
    }
    template <class T>
    static bool read(const Json& json, std::vector<T>& values) {
        if (!json.is_array()) return false;
        for (const Json& entry : json) read(entry, values.emplace_back());
        return true;
    }
    template <class T>
    static bool read(const Json& json, Table<T>& values) {
        if (!json.is_object()) return false;
        for (const auto& [name, entry] : json.items()) read(entry, values.emplace_back(name, T{}).second);
        return true;
    }
};

}  // namespace

Json json_of(const Summary& summary) { return Writer::written(summary); }

std::string text_of(const Summary& summary, int indent) {
    return json_of(summary).dump(indent, ' ', false, Json::error_handler_t::replace);
}

Summary summary_from(const Json& json) {
    Summary summary;
    Reader::read(json, summary);
    return summary;
}

Summary read_summary(const std::string& file, std::string_view text) {
    const auto refuse = [&](const std::string& found) {
        throw InputError(fmt::format("{}: found {}; write the results again with `crackle test --force`", file, found));
    };
    Json json;
    const auto bound_depth = [&](int depth, Json::parse_event_t /*event*/, Json& /*value*/) {
        // The limit prevents deep recursion; a summary has five levels.
        if (depth > 100) refuse("more than 100 nested brackets, expected a test's summary");
        return true;
    };
    try {
        json = Json::parse(without_byte_order_mark(text), bound_depth);
    } catch (const nlohmann::json::parse_error& error) {
        refuse(fmt::format("malformed JSON at byte {}", error.byte));
    } catch (const nlohmann::json::out_of_range&) {
        refuse("a number beyond 1.8e308");
    }
    Summary summary = summary_from(json);
    const auto expect = [&](const char* key, bool right, const char* expected) {
        if (right) return;
        const std::string found = json.is_object() && json.contains(key) ? json[key].dump() : "nothing";
        throw InputError(fmt::format("{}: {}: found {:.40}, expected {}", file, key, found, expected));
    };
    expect("kind", summary.about.kind.has_value(), "a kind of test, such as \"compression\"");
    expect("specimen", summary.about.specimen.has_value(), "\"circles\", \"delaunay\" or \"voronoi\"");
    expect("failed", summary.about.failed.has_value(), "true or false");
    const auto& units = summary.about.material_units;
    expect("material_units", units.has_value() || !units.stated(), "\"point\" or \"area\"");
    return summary;
}

Summary parse_summary(std::string_view text) { return summary_from(Json::parse(text, nullptr, false)); }

}  // namespace crackle
