#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <bitset>
#include <cstdint>
#include <string_view>

namespace cl::drivers {

/// The keys a viewer needs; names are those of the US layout's key caps.
enum class Key : uint8_t {
    W,
    A,
    S,
    D,
    Q,
    E,
    Up,
    Down,
    Left,
    Right,
    Space,
    Shift,
    Control,
    Escape,
    Tab,
    R,
    F,
    P
};
inline constexpr int kKeyCount = 18;
enum class MouseButton : uint8_t { Left, Right, Middle };

/// What the user did up to and in one poll(). A key that went down and up between two polls counts as
/// pressed.
struct InputState {
    std::bitset<kKeyCount> down;     ///< held now
    std::bitset<kKeyCount> pressed;  ///< went down since the last poll
    std::bitset<3> buttons;          ///< held now
    glm::vec2 mouse_motion_px{0.0f}; ///< since the last poll; +x right, +y down
    float scroll = 0.0f;             ///< since the last poll [notches], + is away from the user
    bool resized = false;            ///< the framebuffer's size changed since the last poll
    bool uncovered = false;          ///< what was shown is lost, and has to be drawn again
    bool close_requested = false;    ///< stays true once set

    [[nodiscard]] bool is_down(Key key) const { return down[static_cast<size_t>(key)]; }
    [[nodiscard]] bool was_pressed(Key key) const { return pressed[static_cast<size_t>(key)]; }
    [[nodiscard]] bool is_down(MouseButton button) const { return buttons[static_cast<size_t>(button)]; }
};

enum class MouseMode : uint8_t {
    Free,     ///< visible, leaves the window
    Captured, ///< hidden, motion without bounds: for looking around
};

/// The window side of a GLContext that has one. Main thread only.
class Window {
public:
    virtual ~Window() = default;
    /// Handles pending events. The state lives until the next poll().
    /// @param longest_wait_s  if there are none, sleeps until one comes, but no longer than this
    virtual const InputState& poll(double longest_wait_s = 0.0) = 0;
    virtual void set_mouse_mode(MouseMode mode) = 0;
    virtual void set_title(std::string_view title) = 0;
};

} // namespace cl::drivers
