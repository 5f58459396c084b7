#pragma once

namespace tunica::algebra {

/// Part of a hierarchy that can follow new values of its matrix, whose graph and object stay.
class Refreshable {
public:
  virtual ~Refreshable() = default;
  /// Numeric work only. Throws std::exception where the new values do not permit it. Collective.
  virtual void refresh() = 0;
};

}  // namespace tunica::algebra
