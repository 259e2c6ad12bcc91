#pragma once

#include "drivers/gl_context.h"
#include "drivers/gles3/gl/state.h"

#include "core/io/log.h"

#include <doctest/doctest.h>

#include <memory>
#include <optional>
#include <string>

namespace cl::tests {

/// A context with its State, made current; afterwards it checks that GL had nothing to complain of and that
/// all objects are gone. Contexts are started once a process: the shader compiler's warm-up is the dear part.
class GLTest {
public:
    explicit GLTest(drivers::DriverKind kind) : context_(shared_context(kind)) {
        if (context_) {
            REQUIRE(context_->make_current());
            errors_before_ = context_->error_count();
            state_.emplace();
        }
    }
    ~GLTest() {
        if (!context_) {
            return;
        }
        for (int kind = 0; kind < gles3::gl::kObjectKinds; ++kind) {
            const int own =
                kind == static_cast<int>(gles3::gl::ObjectKind::VertexArray) ? 1 : 0; // the State's
            CHECK(state_->live(static_cast<gles3::gl::ObjectKind>(kind)) == own);
        }
        CHECK(context_->error_count() == errors_before_);
    }
    GLTest(const GLTest&) = delete;
    GLTest& operator=(const GLTest&) = delete;

    [[nodiscard]] bool runs() const { return context_ != nullptr; }
    [[nodiscard]] drivers::GLContext& context() { return *context_; }
    [[nodiscard]] gles3::gl::State& state() { return *state_; }
    /// Runs what is meant to make GL complain, unlogged; its complaints are not held against the test.
    /// @return how many there were
    template <typename F>
    int provoke(F&& f) {
        const LogLevel level = log_level();
        set_log_level(LogLevel::Off);
        const int before = context_->error_count();
        f();
        const int provoked = context_->error_count() - before;
        set_log_level(level);
        errors_before_ += provoked;
        return provoked;
    }

private:
    /// nullptr, and said so, if this machine lacks the driver.
    static drivers::GLContext* shared_context(drivers::DriverKind kind) {
        static std::unique_ptr<drivers::GLContext> contexts[2];
        std::unique_ptr<drivers::GLContext>& context = contexts[static_cast<size_t>(kind)];
        if (!context) {
            Expected<std::unique_ptr<drivers::GLContext>> made = drivers::create_context(kind);
            if (!made) {
                MESSAGE("skipped: " << made.error().message);
                return nullptr;
            }
            context = *std::move(made);
        }
        return context.get();
    }

    drivers::GLContext* context_;
    std::optional<gles3::gl::State> state_;
    int errors_before_ = 0;
};

/// Runs `body(GLTest&)` on every off-screen driver that this machine has.
template <typename Body>
void on_each_gl(Body&& body) {
    for (const drivers::DriverKind kind : {drivers::DriverKind::Egl, drivers::DriverKind::Osmesa}) {
        const std::string driver(drivers::driver_name(kind));
        CAPTURE(driver);
        GLTest gl(kind);
        if (gl.runs()) {
            body(gl);
        }
    }
}

} // namespace cl::tests
