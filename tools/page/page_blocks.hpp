// SPDX-License-Identifier: GPL-3.0-or-later
// The two kinds of blocks in which a page stores its data: plain arrays, and tables of coded integers. page_data.hpp
// describes the format.
// Tested by tests/tools/page/page_data_test.cpp.
#pragma once

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/frames/base64.hpp"

namespace crackle::tools {

static_assert(std::endian::native == std::endian::little,
              "arrays are written in the machine's byte order, which the page expects to be little-endian");

template <class T>
constexpr const char* type_name() {
    if constexpr (std::is_same_v<T, double>) return "f64";
    if constexpr (std::is_same_v<T, float>) return "f32";
    if constexpr (std::is_same_v<T, std::int32_t>) return "i32";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "u8";
}

/// The bytes compressed by zlib, as base64.
inline std::string packed(const std::vector<unsigned char>& bytes) {
    auto size = compressBound(static_cast<uLong>(bytes.size()));
    std::vector<unsigned char> out(size);
    // Level 6 takes a fifth of the time of level 9 and compresses nearly as well, since the data are mostly noise.
    if (compress2(out.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), 6) != Z_OK)
        throw std::runtime_error("zlib could not compress the page's data");
    return encode_base64(std::span(out).first(size));
}

/// A block of plain arrays, one after another, and the position of each array in it.
class PlainBlock {
  public:
    template <class T>
    void add(const std::string& name, const std::vector<T>& values) {
        // The page uses arrays in place, so each must be aligned to its element size.
        bytes_.resize((bytes_.size() + 7) / 8 * 8);
        places_[name] = {{"type", type_name<T>()}, {"offset", bytes_.size()}, {"length", values.size()}};
        const std::size_t begin = bytes_.size();
        bytes_.resize(begin + values.size() * sizeof(T));
        if (!values.empty()) std::memcpy(bytes_.data() + begin, values.data(), values.size() * sizeof(T));
    }
    const nlohmann::ordered_json& places() const { return places_; }
    const std::vector<unsigned char>& bytes() const { return bytes_; }

  private:
    std::vector<unsigned char> bytes_;
    nlohmann::ordered_json places_ = nlohmann::ordered_json::object();
};

/// How a stored integer is converted to a value; see page_data.hpp.
struct Code {
    double quantum = 1.0;
    double growth = 0.0;  ///< relative growth of the steps between values; 0 if all steps are equal

    double number(double value) const {
        return std::round(growth > 0.0 ? std::asinh(value * growth / quantum) / growth : value / quantum);
    }
};

/// Tables of integers, in the format described in page_data.hpp.
class CodedBlock {
  public:
    /// @param where source of the frames, for messages
    explicit CodedBlock(std::string where) : where_(std::move(where)) {}
    const std::string& where() const { return where_; }

    /// @param rows rows of equal length; nothing is stored if they are empty
    void add(const std::string& name, const std::vector<std::vector<double>>& rows, Code code) {
        const std::size_t columns = rows.front().size();
        if (columns == 0) return;
        std::vector<std::uint64_t> coded;
        coded.reserve(rows.size() * columns);
        std::vector<std::int64_t> last(columns, 0);
        for (const std::vector<double>& row : rows) {
            for (std::size_t k = 0; k < columns; ++k) {
                const std::int64_t number = whole(name, row[k], code);
                coded.push_back(zigzag(number - last[k]));
                last[k] = number;
            }
        }
        store(name, coded, rows.size(), columns, code);
    }

    /// Adds a single row, stored as differences between columns.
    void add_row(const std::string& name, const std::vector<double>& row, Code code) {
        std::vector<std::uint64_t> coded;
        coded.reserve(row.size());
        std::int64_t last = 0;
        for (const double value : row) {
            const std::int64_t number = whole(name, value, code);
            coded.push_back(zigzag(number - last));
            last = number;
        }
        store(name, coded, 1, row.size(), code);
    }

    const nlohmann::ordered_json& places() const { return places_; }
    const std::vector<unsigned char>& bytes() const { return bytes_; }

  private:
    static std::uint64_t zigzag(std::int64_t difference) {
        return (static_cast<std::uint64_t>(difference) << 1) ^ static_cast<std::uint64_t>(difference >> 63);
    }

    std::int64_t whole(const std::string& name, double value, Code code) const {
        // Integers up to this value are exact in double precision, in which the page sums them.
        constexpr double most = 1ULL << 50;
        const double number = code.number(value);
        if (!(std::abs(number) < most))
            throw InputError(
                fmt::format("{}: {}: found {}, expected a finite number of ordinary magnitude", where_, name, value));
        return static_cast<std::int64_t>(number);
    }

    void store(const std::string& name, const std::vector<std::uint64_t>& coded, std::size_t rows, std::size_t columns,
               Code code) {
        std::uint64_t all = 1;
        for (const std::uint64_t one : coded) all |= one;
        const auto planes = static_cast<std::size_t>((std::bit_width(all) + 7) / 8);
        places_[name] = {{"quantum", code.quantum},
                         {"offset", bytes_.size()},
                         {"planes", planes},
                         {"rows", rows},
                         {"columns", columns}};
        if (code.growth > 0.0) places_[name]["growth"] = code.growth;
        for (std::size_t plane = 0; plane < planes; ++plane) {
            for (const std::uint64_t one : coded) bytes_.push_back(static_cast<unsigned char>(one >> (8 * plane)));
        }
    }

    std::string where_;
    std::vector<unsigned char> bytes_;
    nlohmann::ordered_json places_ = nlohmann::ordered_json::object();
};

}  // namespace crackle::tools
