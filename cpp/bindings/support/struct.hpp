#pragma once
/// Structs of the core as classes of Python: attributes by name, set by keywords.

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <array>
#include <string>
#include <string_view>

#include "support/columns.hpp"
#include "support/configurations.hpp"

namespace ninedof::python {

/// A struct with the attributes that keywords name; the others keep their values.
template <class T>
T with_keywords(T made, const py::kwargs& given) {
  const py::object object = py::cast(std::move(made));
  for (const auto& [name, value] : given) py::setattr(object, name, value);
  return object.cast<T>();
}

/// A class whose attributes are set by keywords: Name(attribute=value, ...). Those left out have their defaults here.
template <class T>
py::class_<T> request(py::module_& m, const char* name, const char* doc) {
  return py::class_<T>(m, name, doc).def(py::init([](const py::kwargs& given) { return with_keywords(T{}, given); }));
}

/// A getter of an enumeration as one of `words`, in its order.
template <class T, class E, std::size_t N>
auto word_of(E T::* member, const std::array<const char*, N>& words) {
  return [=](const T& from) { return words[static_cast<std::size_t>(from.*member)]; };
}

/// An attribute of an enumeration as one of `words`, in its order.
template <class T, class E, std::size_t N>
void word_attribute(py::class_<T>& owner, const char* name, E T::* member, const std::array<const char*, N>& words,
                    const char* doc) {
  owner.def_property(
      name, word_of(member, words),
      [=](T& to, const std::string& word) {
        std::string all;
        for (std::size_t k = 0; k < N; ++k) {
          if (word == words[k]) {
            to.*member = static_cast<E>(k);
            return;
          }
          all += (k > 0 ? ", \"" : "\"") + std::string(words[k]) + "\"";
        }
        throw InvalidArgument(name, "\"" + word + "\"", "one of " + all);
      },
      doc);
}

/// A getter of a copy: the elements of a list would be references into a struct that may be assigned to.
template <class T, class U>
auto copy_of(U T::* member) {
  return [member](const T& from) { return from.*member; };
}

/// The setter beside it.
template <class T, class U>
auto setter_of(U T::* member) {
  return [member](T& to, U value) { to.*member = std::move(value); };
}

/// A getter of a list as a tuple.
template <class T, class U>
auto tuple_of(U T::* member) {
  return [member](const T& from) { return py::tuple(py::cast(from.*member)); };
}

/// A getter of a list as an array of numbers.
template <class Number, class T, class U>
auto column_of(std::vector<U> T::* member) {
  return [member](const T& from) { return column<Number>(from.*member); };
}

/// A getter of points as an array (n, 3).
template <class T>
auto points_of(std::vector<Vec3> T::* member) {
  return [member](const T& from) { return array_from(from.*member); };
}

}  // namespace ninedof::python
