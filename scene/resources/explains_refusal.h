#pragma once

#include <string>

namespace cl::scene {

/// Mix-in of resources that can say why they refused an assignment, so that the reader of a file can locate
/// it.
class ExplainsRefusal {
public:
    /// "expected ..., found ..." of the last refused assignment; empty if it was accepted.
    [[nodiscard]] virtual const std::string& refusal() const noexcept = 0;

protected:
    ~ExplainsRefusal() = default;
};

} // namespace cl::scene
