// SPDX-License-Identifier: GPL-3.0-or-later
// Records of doubles, stored column by column, so that lanes load a member of consecutive records at once.
// Tested by tests/solver/faces/face_pass_test.cpp.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <type_traits>

#include "solver/base/array.hpp"
#include "solver/base/fields.hpp"

namespace crackle {

template <class Record>
struct FaceColumns {
    static_assert(std::is_trivially_copyable_v<Record>);
    static constexpr std::size_t width = sizeof(Record) / sizeof(double);
    using Row = std::array<double, width>;

    Array<double> numbers;  // one column after the other
    std::size_t count = 0;  // records

    /// Number of records.
    std::size_t size() const { return count; }
    /// A member of all records. @param c its place in the record
    const double* column(std::size_t c) const { return numbers.data() + c * count; }
    double* column(std::size_t c) { return numbers.data() + c * count; }
    /// A record.
    Record operator[](std::size_t k) const {
        Row row;
        for (std::size_t c = 0; c < width; ++c) row[c] = column(c)[k];
        return std::bit_cast<Record>(row);
    }
    /// Replaces a record.
    void set(std::size_t k, const Record& record) {
        const Row row = std::bit_cast<Row>(record);
        for (std::size_t c = 0; c < width; ++c) column(c)[k] = row[c];
    }
    /// Makes room for `records` records, all of zeros.
    void assign(std::size_t records) {
        count = records;
        numbers.assign(width * records, 0.0);
    }

    CRACKLE_FIELDS(numbers, count);
};

}  // namespace crackle
