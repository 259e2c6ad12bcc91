#include "tests/process.h"
#include "tests/shared_dir.h"

#include "core/image.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

namespace {

/// Mean absolute difference of two 8-bit pictures, 0 to 255.
double mean_difference(const cl::Image& a, const cl::Image& b) {
    const cl::Image x = a.converted_to(cl::PixelFormat::RGB8);
    const cl::Image y = b.converted_to(cl::PixelFormat::RGB8);
    double sum = 0.0;
    for (size_t i = 0; i < x.data.size(); ++i) {
        sum += std::abs(static_cast<int>(x.data[i]) - static_cast<int>(y.data[i]));
    }
    return sum / static_cast<double>(x.data.size());
}

bool has_programs() {
    return cl::tests::run_process(
               {"sh", "-c", "command -v xvfb-run && command -v xdotool && command -v import"})
               .exit_status == 0;
}

} // namespace

TEST_SUITE("demo/window") {
    TEST_CASE("[gl] the window shows what render draws, W flies forward, Esc ends") {
        if (!has_programs()) {
            MESSAGE("skipped: needs xvfb-run, xdotool and imagemagick's import");
            return;
        }
        const cl::tests::TemporaryFolder folder;
        const std::string scene = cl::tests::repository_dir() / "demo/scenes/cornell.tscn";
        const std::string script = cl::tests::repository_dir() / "tests/demo/fly_in_window.sh";
        const std::string conelight = cl::tests::conelight_path();
        const auto flight = cl::tests::run_process(
            {"xvfb-run", "-a", "-s", "-screen 0 800x600x24", script, conelight, scene, folder.path()});
        CAPTURE(flight.errors);
        REQUIRE(flight.exit_status == 0);
        const std::string still = folder / "still.png";
        REQUIRE(cl::tests::run_process({conelight, "render", scene, "-q", "--gi", "cones", "--quality", "low",
                                        "--size", "320x180", "-o", still})
                    .exit_status == 0);
        const auto expected = cl::load_image(still);
        const auto start = cl::load_image(folder / "start.png");
        const auto forward = cl::load_image(folder / "forward.png");
        REQUIRE(expected.has_value());
        REQUIRE(start.has_value());
        REQUIRE(forward.has_value());
        REQUIRE(start->size == expected->size);
        REQUIRE(forward->size == expected->size);
        // The same rasteriser draws both; an X server's 24-bit visual keeps all 8 bits.
        CHECK(mean_difference(*start, *expected) < 0.5);
        CHECK(mean_difference(*forward, *expected) > 5.0);
    }
}
