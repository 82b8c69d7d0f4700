// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/world/state_hash.hpp"

#include <xxhash.h>

#include <array>
#include <memory>
#include <optional>
#include <type_traits>

#include "solver/base/fields.hpp"

namespace crackle {
namespace {

class Hash {
  public:
    Hash() : state_(XXH3_createState(), &XXH3_freeState) { XXH3_64bits_reset(state_.get()); }

    template <class T>
    void add(const T& value) {
        if constexpr (HasFields<T>) {
            static_assert(lists_all_fields<T>(), "a member is missing in the struct's fields()");
            T::fields(value, [&](const char* /*name*/, const auto& field, const auto&... /*more*/) { add(field); });
        } else {
            static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
            XXH3_64bits_update(state_.get(), &value, sizeof value);
        }
    }
    template <class T>
    void add(const std::vector<T>& values) {
        add(values.size());
        if constexpr (std::is_arithmetic_v<T>) {
            XXH3_64bits_update(state_.get(), values.data(), values.size() * sizeof(T));
        } else {
            for (const T& value : values) add(value);
        }
    }
    template <class T, std::size_t N>
    void add(const std::array<T, N>& values) {
        for (const T& value : values) add(value);
    }
    template <class T, std::size_t N>
    void add(const T (&values)[N]) {
        for (const T& value : values) add(value);
    }
    template <class T>
    void add(const std::optional<T>& value) {
        add(value.has_value());
        if (value) add(*value);
    }

    std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

  private:
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

}  // namespace

std::vector<FieldHash> hash_fields(const World& world) {
    std::vector<FieldHash> hashes;
    World::groups(world, [&](const std::string& group_name, const auto& group) {
        using Group = std::remove_cvref_t<decltype(group)>;
        static_assert(lists_all_fields<Group>(), "a member is missing in the group's fields()");
        Group::fields(group, [&](const char* name, const auto& field, const auto&... /*more*/) {
            Hash hash;
            hash.add(field);
            hashes.push_back({group_name + "." + name, hash.digest()});
        });
    });
    return hashes;
}

std::uint64_t hash_state(const World& world) {
    std::vector<std::uint64_t> hashes;
    for (const FieldHash& field : hash_fields(world)) hashes.push_back(field.hash);
    return XXH3_64bits(hashes.data(), hashes.size() * sizeof(std::uint64_t));
}

}  // namespace crackle
