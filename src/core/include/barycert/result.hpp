/// One result type for error codes and for exceptions. The library never prints and never exits.
///
/// Example:
///
///     const auto half = [](int n) -> Result<int> {
///         if (n % 2 != 0) return Error{.code = "argument.value", .what = "not even", .found = std::to_string(n)};
///         return n / 2;
///     };
///     const Result<int> r = half(3);
///     const std::string text = r ? std::to_string(*r) : r.error().message();
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "barycert/error_codes.hpp"

namespace barycert {

/// Fault of an input: a code to decide by, and the parts of a message, which leaves out empty ones.
struct Error {
    ErrorCode code;         ///< what kind of error it is: doc/errors.md
    std::string what = {};  ///< one clause: what could not be done
    std::string file = {};  ///< path as the user gave it
    std::size_t line = 0;   ///< 1-based; 0 where no line applies
    std::string expected = {};
    std::string found = {};
    std::string remedy = {};   ///< what to do about it
    std::string subject = {};  ///< the member of a job or of options that it is about, as job.points; empty: none

    /// `file:line: what: expected ..., found ...; remedy`, in one line: safe to show, see printable() in text.hpp.
    std::string message() const;
};

/// Returns an error of a whole file.
inline Error file_error(ErrorCode code, std::string file, std::string what, std::string expected = {},
                        std::string found = {}, std::string remedy = {}) {
    return {code, std::move(what), std::move(file), 0, std::move(expected), std::move(found), std::move(remedy)};
}

/// Returns the error with that subject. Its texts may name members, as job.points: a program that calls them
/// otherwise finds by the subject that they do.
inline Error about(std::string subject, Error error) {
    error.subject = std::move(subject);
    return error;
}

/// Thrown by Result::value() when there is an error instead of a value.
class Exception : public std::runtime_error {
public:
    explicit Exception(Error error) : std::runtime_error(error.message()), error_(std::move(error)) {}
    const Error& error() const { return error_; }

private:
    Error error_;
};

/// Either a value or an Error: `if (r) use(*r); else tell(r.error())`, or `r.value()` which throws Exception.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::move(value)) {}
    Result(Error error) : state_(std::move(error)) {}

    bool has_value() const { return std::holds_alternative<T>(state_); }
    explicit operator bool() const { return has_value(); }

    /// Requires: has_value().
    T& operator*() { return std::get<T>(state_); }
    const T& operator*() const { return std::get<T>(state_); }
    T* operator->() { return &std::get<T>(state_); }
    const T* operator->() const { return &std::get<T>(state_); }

    /// Requires: !has_value().
    const Error& error() const { return std::get<Error>(state_); }

    /// The value; throws Exception if there is none.
    T& value() & {
        if (!has_value()) throw Exception(error());
        return **this;
    }
    T&& value() && {
        if (!has_value()) throw Exception(error());
        return std::move(**this);
    }

private:
    std::variant<T, Error> state_;
};

/// For operations that return nothing but may fail.
struct Done {};
using Status = Result<Done>;

// Notes of all that was left out, converted or guessed on the way from files to files: nothing of that happens in
// silence.

struct Note {
    enum class Kind : std::uint8_t {
        left_out,   ///< it is not in the result
        converted,  ///< it is in the result in another type, order or unit
        guessed,    ///< the file does not say; this was taken from its contents
    };
    Kind kind = Kind::left_out;
    std::string text;          ///< what and why, in one clause: "2564 cells that are no tetrahedra: 2564 triangles"
    std::string file = {};     ///< where; empty: in memory
    bool important = false;    ///< it may change what results mean: a program tells it even if nobody asks
    std::string subject = {};  ///< a member of the job that the text names, as in Error

    friend bool operator==(const Note&, const Note&) = default;
};
using Notes = std::vector<Note>;

constexpr std::string_view name(Note::Kind kind) {
    return kind == Note::Kind::left_out ? "left out" : kind == Note::Kind::converted ? "converted" : "guessed";
}

/// `file: kind: text`, in one line: safe to show, see printable() in core/base/text.hpp.
std::string message(const Note& note);

}  // namespace barycert
