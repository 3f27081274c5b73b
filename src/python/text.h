// Texts between C++ and Python, whatever bytes they hold.
//
// Names and paths come from other people's files and may be no UTF-8. As everywhere in Python (PEP 383), such bytes travel as
// lone surrogates and are the same bytes when they come back. Replaces nanobind's own casters: include one or the other.
#pragma once

#include <nanobind/nanobind.h>

#include <string>
#include <string_view>

namespace nanobind::detail {

/// The bytes of a str. False if it is none, or holds surrogates that stand for no bytes.
inline bool text_of_python(handle from, std::string& text) noexcept {
    if (!PyUnicode_Check(from.ptr())) return false;
    PyObject* bytes = PyUnicode_AsEncodedString(from.ptr(), "utf-8", "surrogateescape");
    if (bytes == nullptr) {
        PyErr_Clear();
        return false;
    }
    text.assign(PyBytes_AS_STRING(bytes), static_cast<std::size_t>(PyBytes_GET_SIZE(bytes)));
    Py_DECREF(bytes);
    return true;
}

/// A new str, or null with a Python error set.
inline handle text_to_python(std::string_view text) noexcept {
    return PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()),
                                "surrogateescape");
}

template <>
struct type_caster<std::string> {
    NB_TYPE_CASTER(std::string, const_name("str"))

    bool from_python(handle from, std::uint8_t, cleanup_list*) noexcept {
        return text_of_python(from, value);
    }
    static handle from_cpp(const std::string& text, rv_policy, cleanup_list*) noexcept {
        return text_to_python(text);
    }
};

template <>
struct type_caster<std::string_view> {
    NB_TYPE_CASTER(std::string_view, const_name("str"))

    bool from_python(handle from, std::uint8_t, cleanup_list*) noexcept {
        const bool good = text_of_python(from, kept_);
        value = kept_;
        return good;
    }
    static handle from_cpp(std::string_view text, rv_policy, cleanup_list*) noexcept {
        return text_to_python(text);
    }

  private:
    std::string kept_;  ///< for as long as the call lasts
};

}  // namespace nanobind::detail
