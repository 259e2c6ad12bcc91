#pragma once

#include <string>

namespace cl {

/// Two ways to spell a value as text.
enum class TextStyle {
    /// For files: Godot's spelling wherever that reads back as the same value, else the nearest spelling that
    /// does and that Godot 3.2.3 reads too: more than 6 digits where needed, infinity as 1e400.
    Exact,
    /// Godot 3.2.3's own spelling (var2str) to the letter: reals as float32 with 6 significant digits, `inf`
    /// and
    /// `nan` even where its reader refuses them.
    Godot,
};

// All of these append to `out`.

/// A real that is a value by itself: always with '.', 'e' or a name, so that it reads back as a real.
void append_real(std::string& out, double value, TextStyle style);
/// A float inside a constructor such as Vector3( ... ): "1" for 1. Not-a-number has no readable spelling
/// there; in Exact style it becomes 0, so that the rest of the file stays readable.
void append_component(std::string& out, float value, TextStyle style);
/// A real as Godot's str() shows it: 6 decimals, trailing zeros dropped.
void append_shown_real(std::string& out, double value);

} // namespace cl
