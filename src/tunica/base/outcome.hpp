#pragma once
#include <optional>
#include <string>
#include <utility>

namespace tunica {

/// Success, or the reason of a failure, phrased to follow a colon: "the wall: " + reason(). For
/// failures that may occur in a valid run; bad input and internal errors are thrown (error.hpp).
class [[nodiscard]] Outcome {
public:
  static Outcome success() { return Outcome(); }
  static Outcome failure(std::string reason) {
    Outcome outcome;
    outcome.reason_ = std::move(reason);
    return outcome;
  }

  bool is_success() const { return !reason_; }
  bool is_failure() const { return !is_success(); }
  /// Why not; empty after success.
  std::string reason() const { return reason_.value_or(""); }

  /// A failure with "where: " before its reason; success as it is.
  Outcome at(const std::string& where) const {
    return is_success() ? *this : failure(where + ": " + *reason_);
  }

private:
  Outcome() = default;

  std::optional<std::string> reason_;
};

/// A value, or the reason why there is none.
template <class T>
class [[nodiscard]] Result {
public:
  Result(T value) : value_(std::move(value)), outcome_(Outcome::success()) {}
  static Result failure(std::string reason) { return Result(Outcome::failure(std::move(reason))); }

  bool is_success() const { return outcome_.is_success(); }
  bool is_failure() const { return outcome_.is_failure(); }
  std::string reason() const { return outcome_.reason(); }
  /// The outcome without the value, for a caller that passes a failure on.
  const Outcome& outcome() const { return outcome_; }

  /// Throws std::bad_optional_access after a failure.
  const T& value() const& { return value_.value(); }
  T&& value() && { return std::move(value_).value(); }

private:
  explicit Result(Outcome failure) : outcome_(std::move(failure)) {}

  std::optional<T> value_;
  Outcome outcome_;
};

}  // namespace tunica
