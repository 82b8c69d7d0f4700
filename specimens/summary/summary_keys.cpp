// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/summary/summary_keys.hpp"

#include <set>
#include <typeindex>

namespace crackle {
namespace {

/// Lists the keys of the visited members.
struct KeyLister {
    std::vector<SummaryKey>& keys;
    std::set<std::type_index>& tables;  ///< types of the tables that have been listed
    std::string prefix = "";
    bool again = false;

    template <class T>
    void operator()(const char* name, const T& /*figure*/, const FigureRow& row = {}) {
        if constexpr (HasFields<T>) {
            T::fields(T{}, *this);
        } else {
            const auto list = [&](const char* meaning, const char* more) {
                keys.push_back({prefix + name, row.unit == unlisted ? "" : row.unit, meaning, more,
                                std::same_as<T, Stress>, again});
            };
            const bool described = *row.meaning != '\0' || row.unit == unlisted || *row.unit != '\0';
            if (described) list(row.meaning, row.more);
            for (const auto& [meaning, more] : row.others) list(meaning, more);
            list_within(prefix + name, described, typename T::value_type{});
        }
    }
    template <class T>
    void list_within(const std::string& name, bool described, const T& /*table*/) {
        if constexpr (HasFields<T>) {
            const bool listed = !tables.insert(typeid(T)).second;
            if (!listed || described)
                T::fields(T{}, KeyLister{keys, tables, (described ? name : prefix + '*') + '.', again || listed});
        }
    }
    template <class T>
    void list_within(const std::string& name, bool /*described*/, const std::vector<T>& /*list*/) {
        list_within(name + "[]", true, T{});
    }
    template <class T>
    void list_within(const std::string& name, bool /*described*/, const Table<T>& /*table*/) {
        list_within(name + ".*", true, T{});
    }
};

/// Lists the units and meanings of the visited members that have a value or null, and converts stresses to Pa.
struct UnitLister {
    Table<std::string>& units;
    bool area_units;
    double thickness;

    template <class T>
    void operator()(const std::string& name, T& figure, const FigureRow& row) const {
        if constexpr (HasFields<T>) {
            T::fields(figure, *this);
        } else if (figure.stated() && row.unit != unlisted) {
            const char* meaning = row.meaning;
            if constexpr (std::same_as<T, NumberBySense>)
                if (figure.sense > 0) meaning = row.others[figure.sense - 1].first;
            units.emplace_back(name, stated_in({name.c_str(), row.unit, meaning}, area_units));
            if constexpr (std::same_as<T, Stress>) {
                figure.converted = figure.or_nan() / thickness;
                units.emplace_back(name + converted_suffix,
                                   area_units ? "Pa, the same value, which is already in Pa"
                                              : "Pa, the same value divided by out_of_plane_thickness");
            }
        }
    }
};

}  // namespace

const std::vector<SummaryKey>& summary_keys() {
    static const std::vector<SummaryKey> all = [] {
        std::vector<SummaryKey> keys;
        std::set<std::type_index> tables;
        Summary::fields(Summary{}, KeyLister{keys, tables});
        return keys;
    }();
    return all;
}

std::string_view without_suffix(std::string_view key) {
    if (key.ends_with(converted_suffix)) key.remove_suffix(std::string_view(converted_suffix).size());
    return key;
}

std::string stated_in(const Quantity& what, bool area_units) {
    std::string text = stated(what);
    const std::size_t at = area_units ? text.find("N/m") : std::string::npos;
    return at == std::string::npos ? text : text.replace(at, 3, "Pa");
}

void state_units(Summary& summary) {
    const bool area = summary.about.material_units == StiffnessUnits::area;
    Table<std::string> units;
    Summary::fields(summary, UnitLister{units, area, area ? 1.0 : summary.out_of_plane_thickness.value_or(1.0)});
    summary.units = units;
}

}  // namespace crackle
