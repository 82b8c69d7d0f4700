// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a page of `crackle report` or `crackle view` as described in tools/page/page_data.hpp, without using the
// program's code.
#pragma once

#include <fmt/format.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/demseg/deck_reader.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/frames/base64.hpp"

namespace crackle::testing {

class PageContents {
  public:
    explicit PageContents(const std::filesystem::path& page) : text_(read_file(page)) {
        manifest = nlohmann::json::parse(element("crackle-data"));
    }

    nlohmann::json manifest;

    const nlohmann::json& test(std::size_t t = 0) const { return manifest["tests"][t]; }

    /// A plain array of block 0.
    std::vector<double> plain(const std::string& name, std::size_t t = 0) const {
        const nlohmann::json& place = test(t)["arrays"].at(name);
        const std::vector<unsigned char> bytes = block(t, 0);
        const std::string type = place["type"];
        const auto values = [&]<class T>(T) {
            std::vector<double> all;
            for (std::size_t k = 0; k < place["length"]; ++k) {
                T value;
                std::memcpy(&value, bytes.data() + std::size_t(place["offset"]) + k * sizeof(T), sizeof(T));
                all.push_back(static_cast<double>(value));
            }
            return all;
        };
        if (type == "f64") return values(double{});
        if (type == "f32") return values(float{});
        if (type == "i32") return values(std::int32_t{});
        return values(std::uint8_t{});
    }

    struct Table {
        double quantum = 0.0;
        double growth = 0.0;                    ///< if 0, value = quantum n; otherwise quantum / growth sinh(growth n)
        std::vector<std::vector<double>> rows;  ///< one row per frame of the block; a single row for contacts
    };
    bool has(const std::string& name, std::size_t group, std::size_t t = 0) const {
        return test(t)["groups"][group]["arrays"].contains(name);
    }
    Table coded(const std::string& name, std::size_t group, std::size_t t = 0) const {
        const nlohmann::json& entry = test(t)["groups"][group];
        const nlohmann::json& place = entry["arrays"].at(name);
        const std::vector<unsigned char> bytes = block(t, entry["block"]);
        const std::size_t rows = place["rows"], columns = place["columns"], planes = place["planes"];
        Table table{place["quantum"], place.value("growth", 0.0), {}};
        const bool along_columns = name.starts_with("contacts.");
        std::vector<std::int64_t> last(columns, 0);
        for (std::size_t f = 0; f < rows; ++f) {
            table.rows.emplace_back();
            for (std::size_t k = 0; k < columns; ++k) {
                std::uint64_t u = 0;
                for (std::size_t p = 0; p < planes; ++p) {
                    const std::size_t at = std::size_t(place["offset"]) + (p * rows + f) * columns + k;
                    u |= std::uint64_t{bytes.at(at)} << (8 * p);
                }
                const std::int64_t difference = u % 2 == 0 ? std::int64_t(u / 2) : -std::int64_t(u / 2) - 1;
                std::int64_t& number = last[along_columns ? 0 : k];
                number += difference;
                const auto n = static_cast<double>(number);
                table.rows.back().push_back(table.growth > 0.0
                                                ? table.quantum / table.growth * std::sinh(table.growth * n)
                                                : table.quantum * n);
            }
        }
        return table;
    }
    /// The row of a frame, counted over all blocks.
    std::vector<double> row(const std::string& name, std::size_t frame, std::size_t t = 0) const {
        for (std::size_t g = 0; g < test(t)["groups"].size(); ++g) {
            const nlohmann::json& group = test(t)["groups"][g];
            const std::size_t first = group["first"], count = group["count"];
            if (frame >= first && frame < first + count) return coded(name, g, t).rows[frame - first];
        }
        throw std::out_of_range("no such frame");
    }

  private:
    std::string element(const std::string& id) const {
        const std::string opening = fmt::format("id=\"{}\">", id);
        const std::size_t begin = text_.find(opening);
        if (begin == std::string::npos) throw std::out_of_range("the page has no element " + id);
        return text_.substr(begin + opening.size(), text_.find("</script>", begin) - begin - opening.size());
    }

    std::vector<unsigned char> block(std::size_t t, std::size_t b) const {
        const auto packed = decode_base64(element(fmt::format("crackle-{}-{}", t, b)));
        if (!packed) throw std::runtime_error("a block is not base64");
        std::vector<unsigned char> bytes(1 << 24);
        auto size = static_cast<uLongf>(bytes.size());
        if (uncompress(bytes.data(), &size, packed->data(), static_cast<uLong>(packed->size())) != Z_OK)
            throw std::runtime_error("a block cannot be unpacked");
        bytes.resize(size);
        return bytes;
    }

    std::string text_;
};

}  // namespace crackle::testing
