// SPDX-License-Identifier: GPL-3.0-or-later
// Provides arrays of the engine as read-only numpy arrays that use the engine's memory. Records become structured types
// with the fields listed for them (solver/base/fields.hpp).
//
// A view shows the state at the time it was created, without a copy. If a view still exists when the engine continues,
// the view keeps the memory and the engine continues with a copy (Loans::settle). A view therefore never changes and
// never dangles, whatever is released first.
// Tested by tests/tools/python/world_test.py.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/base/fields.hpp"

namespace crackle::python {

namespace py = pybind11;

template <class T>
py::object dtype_of();

/// Collects the fields of a numpy dtype.
class DtypeParts {
  public:
    explicit DtypeParts(const void* record) : record_(static_cast<const char*>(record)) {}

    template <class T, class... More>
    void operator()(const char* name, T& field, const More&... /*more*/) {
        using Plain = std::remove_cv_t<T>;
        names_.append(name);
        offsets_.append(reinterpret_cast<const char*>(&field) - record_);
        if constexpr (std::is_array_v<Plain>)
            formats_.append(
                py::make_tuple(dtype_of<std::remove_extent_t<Plain>>(), py::make_tuple(std::extent_v<Plain>)));
        else
            formats_.append(dtype_of<Plain>());
    }
    py::dtype dtype(std::size_t size) {
        return {std::move(names_), std::move(formats_), std::move(offsets_), static_cast<py::ssize_t>(size)};
    }

  private:
    const char* record_;
    py::list names_, formats_, offsets_;
};

/// Loads numpy before any function-local static below needs it. Loading releases the interpreter lock; another thread
/// that acquires the lock and waits for such a static would then block forever.
inline void need_numpy() {
    static bool there = false;  // protected by the interpreter lock, like all statics below
    if (there) return;
    py::module_::import("numpy");
    there = true;
}

/// The numpy dtype for a C++ type. A structured dtype is created only once.
template <class T>
py::object dtype_of() {
    need_numpy();
    if constexpr (HasFields<T>) {
        static py::object* made =
            nullptr;  // never freed, since the interpreter may end before static objects are destroyed
        if (made == nullptr) {
            const T record{};
            DtypeParts parts(&record);
            T::fields(record, parts);
            auto dtype = std::make_unique<py::object>(parts.dtype(sizeof(T)));
            if (made == nullptr) made = dtype.release();  // another thread may have created it in the meantime
        }
        return *made;
    } else if constexpr (std::is_enum_v<T>) {
        return py::dtype::of<std::underlying_type_t<T>>();
    } else {
        return py::dtype::of<T>();
    }
}

/// A read-only array over memory that `keeper` keeps alive.
inline py::array view_of(const py::object& dtype, std::size_t count, std::size_t size, const void* data,
                         const py::object& keeper) {
    py::array view(py::reinterpret_borrow<py::dtype>(dtype), {static_cast<py::ssize_t>(count)},
                   {static_cast<py::ssize_t>(size)}, data, keeper);
    py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return view;
}

/// A Python capsule that keeps a shared object alive.
inline py::capsule keep(std::shared_ptr<void> shared) {
    auto held = std::make_unique<std::shared_ptr<void>>(std::move(shared));
    py::capsule capsule(held.get(), [](void* kept) { delete static_cast<std::shared_ptr<void>*>(kept); });
    static_cast<void>(held.release());  // the capsule now owns this object
    return capsule;
}

/// A numpy view of an array in a scene, result or other object that does not change while it is shared.
template <class Array>
py::array view_of(const Array& values, std::shared_ptr<void> owner) {
    using T = typename Array::value_type;
    return view_of(dtype_of<T>(), values.size(), sizeof(T), values.data(), keep(std::move(owner)));
}

/// Arrays of a changing object that are lent to numpy views.
class Loans {
  public:
    /// @param owner object that contains the array; kept alive until settle() or the end of the view. May be null if
    /// settle() is always called first
    template <class Array>
    py::array lend(Array& values, std::shared_ptr<void> owner) {
        using T = typename Array::value_type;
        std::shared_ptr<Loan> loan;  // one per array, since all views of an array share its memory
        std::erase_if(loans_, [](const auto& one) { return one.expired(); });
        for (const std::weak_ptr<Loan>& one : loans_)
            if (std::shared_ptr<Loan> held = one.lock(); held && held->array == &values) loan = std::move(held);
        if (!loan) {
            loan = std::make_shared<LoanOf<Array>>(values, std::move(owner));
            loans_.emplace_back(loan);
        }
        return view_of(dtype_of<T>(), values.size(), sizeof(T), values.data(), keep(std::move(loan)));
    }

    /// Call this before the engine changes lent arrays. Views that still exist keep the memory, and the engine gets a
    /// copy.
    void settle() {
        for (const std::weak_ptr<Loan>& one : loans_)
            if (const std::shared_ptr<Loan> held = one.lock()) held->settle();
        loans_.clear();
    }

  private:
    struct Loan {
        explicit Loan(const void* lent_array) : array(lent_array) {}
        Loan(const Loan&) = delete;
        Loan& operator=(const Loan&) = delete;
        virtual ~Loan() = default;
        virtual void settle() = 0;
        const void* array;
    };
    template <class Array>
    struct LoanOf final : Loan {
        LoanOf(Array& values, std::shared_ptr<void> its_owner)
            : Loan(&values), lent(&values), owner(std::move(its_owner)) {}
        void settle() override {
            Array copy = *lent;
            kept = std::move(*lent);
            *lent = std::move(copy);
            owner.reset();
        }
        Array* lent;
        Array kept;  // holds the viewed values once settle() has given the engine a copy
        std::shared_ptr<void> owner;
    };

    std::vector<std::weak_ptr<Loan>> loans_;
};

}  // namespace crackle::python
