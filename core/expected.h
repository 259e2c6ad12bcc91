#pragma once

#include "core/assert.h"

#include <string>
#include <utility>
#include <variant>

namespace cl {

enum class ErrorCode {
    InvalidArgument, ///< a stale RID, a value out of range
    NotFound,        ///< a file, node, property or resource that is not there
    ParseError,      ///< text or bytes that are not what their format says
    IoError,         ///< the operating system refused a read or write
    Unsupported,     ///< right, but not something this build or driver can do
    OutOfMemory,     ///< an input asks for more than its limits allow
    Cancelled,
};

/// Where in a file a problem was found. line and column count from 1; 0 means "not known".
struct SourceLocation {
    std::string file;
    int line = 0;
    int column = 0;

    /// "file:line:column: ", leaving out the parts that are not known; empty if none is.
    [[nodiscard]] std::string prefix() const;
};

/// What went wrong, for a person: one line, no newline at its end, "expected ..., found ..." where it fits.
struct Error {
    ErrorCode code = ErrorCode::InvalidArgument;
    std::string message;
    SourceLocation where{};

    /// `file:line:column: error: message`, leaving out the parts of the place that are not known.
    [[nodiscard]] std::string to_string() const;
};

/// A value or an Error; spelled like std::expected (C++23) so that moving to it is mechanical.
template <typename T>
class [[nodiscard]] Expected {
public:
    using value_type = T;

    Expected(T value) : storage_(std::in_place_index<0>, std::move(value)) {}
    Expected(Error error) : storage_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool has_value() const noexcept { return storage_.index() == 0; }
    explicit operator bool() const noexcept { return has_value(); }

    [[nodiscard]] T& value() & {
        CL_ASSERT(has_value(), "value() of an Expected that holds an error");
        return std::get<0>(storage_);
    }
    [[nodiscard]] const T& value() const& {
        CL_ASSERT(has_value(), "value() of an Expected that holds an error");
        return std::get<0>(storage_);
    }
    [[nodiscard]] T&& value() && {
        CL_ASSERT(has_value(), "value() of an Expected that holds an error");
        return std::get<0>(std::move(storage_));
    }
    [[nodiscard]] T& operator*() & { return value(); }
    [[nodiscard]] const T& operator*() const& { return value(); }
    [[nodiscard]] T&& operator*() && { return std::move(*this).value(); }
    [[nodiscard]] T* operator->() { return &value(); }
    [[nodiscard]] const T* operator->() const { return &value(); }

    [[nodiscard]] const Error& error() const& {
        CL_ASSERT(!has_value(), "error() of an Expected that holds a value");
        return std::get<1>(storage_);
    }
    [[nodiscard]] Error&& error() && {
        CL_ASSERT(!has_value(), "error() of an Expected that holds a value");
        return std::get<1>(std::move(storage_));
    }

private:
    std::variant<T, Error> storage_;
};

/// Success, or an Error. `return {};` is success.
class [[nodiscard]] Status {
public:
    Status() = default;
    Status(Error error) : storage_(std::move(error)) {}

    [[nodiscard]] bool ok() const noexcept { return storage_.index() == 0; }
    explicit operator bool() const noexcept { return ok(); }
    [[nodiscard]] const Error& error() const {
        CL_ASSERT(!ok(), "error() of a Status that is ok");
        return std::get<1>(storage_);
    }

private:
    std::variant<std::monostate, Error> storage_;
};

} // namespace cl
