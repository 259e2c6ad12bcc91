#include "tests/captured_stderr.h"
#include "tests/servers/probe_octree.h"

#include "drivers/dummy/dummy_rasterizer.h"

#include "servers/gi/bricks.h"
#include "servers/gi/s3tc.h"
#include "servers/probe/probe_machine.h"
#include "servers/rasterizer_checked.h"

#include "core/io/log.h"

#include <doctest/doctest.h>

#include <deque>
#include <string>

using namespace cl;
using dummy::CallKind;

namespace {

std::shared_ptr<const gi::CellLayout> floor_layout() {
    const Expected<gi::Octree> octree = gi::decode_octree(tests::floor_probe_data().dynamic_data);
    REQUIRE(octree);
    return std::make_shared<const gi::CellLayout>(gi::make_layout(*octree));
}

ProbeLight lamp(uint32_t slot, glm::vec3 cell, glm::vec3 color = glm::vec3(1.0f)) {
    LightDesc desc;
    desc.range_m = 12.0f;
    desc.color = {color.r, color.g, color.b, 1.0f};
    Transform world_from_light;
    world_from_light.origin = cell;
    return make_probe_light({slot, 1}, desc, true, world_from_light, {});
}

/// One machine over a recording rasteriser, with a worker that runs when it is told to.
struct Machine {
    dummy::DummyRasterizer* dummy;
    std::unique_ptr<RasterizerChecked> rasterizer;
    std::deque<std::function<void()>> jobs;
    RunJob later = [this](std::function<void()> job) { jobs.push_back(std::move(job)); };
    ProbeMachine machine{"GI probe 7"};

    std::vector<ProbeLight> lights;
    std::shared_ptr<const gi::CellLayout> layout;
    gi::TexelCoding coding = gi::TexelCoding::Plain;
    uint64_t data_version = 0;
    float propagation = 0.7f;
    int dynamic_range = 4;

    Machine() {
        auto recorder = std::make_unique<dummy::DummyRasterizer>();
        dummy = recorder.get();
        rasterizer = std::make_unique<RasterizerChecked>(std::move(recorder));
    }
    ~Machine() { machine.release(*rasterizer); }

    void give_data() {
        layout = floor_layout();
        ++data_version;
    }
    ProbeWanted wanted() const { return {layout, coding, data_version, propagation, dynamic_range, lights}; }
    Status step() { return machine.step(wanted(), *rasterizer, later); }
    void work() {
        for (; !jobs.empty(); jobs.pop_front()) {
            jobs.front()();
        }
    }
    /// Steps and works until nothing is pending.
    void settle() {
        for (int round = 0; machine.is_pending(wanted()); ++round) {
            REQUIRE(round < 10);
            REQUIRE(step());
            work();
        }
    }
    std::vector<uint8_t> texels() const {
        std::vector<uint8_t> all;
        for (int mip = 0; !dummy->volume_texels(machine.volume(), mip).empty(); ++mip) {
            const std::span<const uint8_t> level = dummy->volume_texels(machine.volume(), mip);
            all.insert(all.end(), level.begin(), level.end());
        }
        return all;
    }
    /// How many uploads fill the volume.
    size_t all_bricks() const {
        size_t bricks = 0;
        for (int mip = 0; mip < gi::mip_count(*layout, coding); ++mip) {
            bricks += gi::bricks_of_mip(*layout, static_cast<size_t>(mip)).bricks.size();
        }
        return bricks;
    }
    /// What a machine that never saw another state would show.
    std::vector<uint8_t> fresh_texels() const {
        Machine fresh;
        fresh.layout = layout;
        fresh.coding = coding;
        fresh.data_version = 1;
        fresh.lights = lights;
        fresh.propagation = propagation;
        fresh.dynamic_range = dynamic_range;
        fresh.settle();
        return fresh.texels();
    }
};

/// A machine at rest in Check, lit by one lamp.
struct SettledMachine : Machine {
    SettledMachine() {
        give_data();
        lights = {lamp(1, {30.0f, 4.0f, 4.0f})};
        settle();
        dummy->forget_calls();
    }
};

bool has_light(const std::vector<uint8_t>& texels) {
    for (size_t i = 0; i < texels.size(); i += 4) {
        if (texels[i] > 0) {
            return true;
        }
    }
    return false;
}

} // namespace

TEST_SUITE("servers/probe/probe_machine") {
    TEST_CASE("without data a probe stays unset and asks nothing of the rasteriser") {
        Machine m;
        REQUIRE(m.step());
        CHECK(m.machine.stage() == ProbeStage::Unset);
        CHECK(!m.machine.is_pending(m.wanted()));
        CHECK(m.dummy->calls().empty());
    }

    TEST_CASE("with data a probe is set up and handed to the worker in one step, uploaded in the next") {
        Machine m;
        m.give_data();
        m.lights = {lamp(1, {30.0f, 4.0f, 4.0f})};
        REQUIRE(m.step());
        CHECK(m.machine.stage() == ProbeStage::Lighting);
        CHECK(m.jobs.size() == 1);
        CHECK(m.dummy->count(CallKind::VolumeCreate) == 1);
        CHECK(m.dummy->count(CallKind::VolumeUpload) == 0);
        CHECK(!has_light(m.texels())); // black, not undefined
        m.work();
        REQUIRE(m.step());
        CHECK(m.machine.stage() == ProbeStage::Check);
        const int mips = gi::mip_count(m.layout->dims);
        CHECK(m.dummy->count(CallKind::VolumeUpload) == m.all_bricks());
        CHECK(m.dummy->volume_desc(m.machine.volume())->mip_count == mips);
        CHECK(has_light(m.texels()));
        CHECK(m.machine.shown_dynamic_range() == 4);
    }

    TEST_CASE("while nothing changes nothing is done") {
        SettledMachine m;
        for (int i = 0; i < 5; ++i) {
            REQUIRE(m.step());
        }
        CHECK(m.machine.stage() == ProbeStage::Check);
        CHECK(m.jobs.empty());
        CHECK(m.dummy->calls().empty());
    }

    TEST_CASE("while the worker is busy a probe waits, however often it is stepped") {
        SettledMachine m;
        m.propagation = 0.1f;
        for (int i = 0; i < 5; ++i) {
            REQUIRE(m.step());
            CHECK(m.machine.stage() == ProbeStage::Lighting);
        }
        CHECK(m.jobs.size() == 1);
        CHECK(m.dummy->calls().empty());
    }

    TEST_CASE("even a worker that is done at once has its volume uploaded in a later step") {
        Machine m;
        m.give_data();
        const RunJob at_once = [](const std::function<void()>& job) { job(); };
        REQUIRE(m.machine.step(m.wanted(), *m.rasterizer, at_once));
        CHECK(m.machine.stage() == ProbeStage::Lighting);
        CHECK(m.dummy->count(CallKind::VolumeUpload) == 0);
        REQUIRE(m.machine.step(m.wanted(), *m.rasterizer, at_once));
        CHECK(m.machine.stage() == ProbeStage::Check);
        CHECK(m.dummy->count(CallKind::VolumeUpload) > 0);
    }

    TEST_CASE("every kind of change leads to the volume of a fresh set-up with one relight") {
        const auto check = [](const char* what, const std::function<void(Machine&)>& change) {
            CAPTURE(what);
            SettledMachine m;
            const std::vector<uint8_t> before = m.texels();
            change(m);
            CHECK(m.machine.is_pending(m.wanted()));
            REQUIRE(m.step());
            CHECK(m.machine.stage() == ProbeStage::Lighting);
            CHECK(m.jobs.size() == 1);
            m.work();
            REQUIRE(m.step());
            CHECK(m.machine.stage() == ProbeStage::Check);
            CHECK(m.texels() != before);
            CHECK(m.texels() == m.fresh_texels());
            CHECK(!m.machine.is_pending(m.wanted()));
        };
        check("added", [](Machine& m) { m.lights.push_back(lamp(2, {36.0f, 3.0f, 2.0f})); });
        check("removed", [](Machine& m) { m.lights.clear(); });
        check("moved", [](Machine& m) { m.lights[0] = lamp(1, {28.0f, 4.0f, 4.0f}); });
        check("recoloured", [](Machine& m) { m.lights[0].light.color = {0.2f, 0.9f, 0.4f}; });
        check("re-energised", [](Machine& m) { m.lights[0].light.energy = 0.5f; });
        check("reshaped", [](Machine& m) { m.lights[0].light.range_m = 6.0f; });
        check("hidden", [](Machine& m) {
            m.lights[0].presence = LightPresence::Hidden;
            m.lights[0].light.visible = false;
        });
        check("re-moded", [](Machine& m) {
            m.lights[0].presence = LightPresence::BakeDisabled;
            m.lights[0].light.visible = false;
        });
        check("propagation", [](Machine& m) { m.propagation = 0.0f; });
        check("dynamic range", [](Machine& m) { m.dynamic_range = 2; });
    }

    TEST_CASE("a propagation change while the worker is busy is not lost") {
        SettledMachine m;
        m.lights[0].light.energy = 0.3f;
        REQUIRE(m.step());
        m.propagation = 0.05f; // Lighting: the order that is under way does not know of it
        REQUIRE(m.step());
        m.work();
        REQUIRE(m.step());
        CHECK(m.machine.stage() == ProbeStage::Lighting); // uploaded, checked, and off again
        m.work();
        REQUIRE(m.step());
        CHECK(m.machine.stage() == ProbeStage::Check);
        CHECK(m.texels() == m.fresh_texels());
    }

    TEST_CASE("a propagation change before the first light is not lost") {
        Machine m;
        m.give_data();
        REQUIRE(m.step());
        m.propagation = 0.0f;
        m.work();
        m.settle();
        CHECK(m.texels() == m.fresh_texels());
    }

    TEST_CASE("a relight that changes no texel uploads nothing") {
        SettledMachine m;
        ProbeLight far_off = lamp(2, {1000.0f, 4.0f, 4.0f});
        m.lights.push_back(far_off);
        m.settle();
        CHECK(m.machine.stage() == ProbeStage::Check);
        CHECK(m.dummy->count(CallKind::VolumeUpload) == 0);
    }

    TEST_CASE("only the bricks that changed are uploaded") {
        SettledMachine m;
        m.lights.push_back(
            lamp(2, {20.0f, 2.0f, 2.0f})); // its range of 12 cells ends before the bricks at 32
        m.settle();
        CHECK(m.dummy->count(CallKind::VolumeUpload) > 0);
        CHECK(m.dummy->count(CallKind::VolumeUpload) < m.all_bricks());
        CHECK(m.texels() == m.fresh_texels());
    }

    TEST_CASE("only the mips that changed are uploaded") {
        SettledMachine m;
        m.propagation = 0.69f; // leaves keep their energy, the levels above do not
        m.settle();
        for (const dummy::Call& call : m.dummy->calls()) {
            CHECK(call.kind == CallKind::VolumeUpload);
            CHECK(call.mip > 0);
        }
        CHECK(m.texels() == m.fresh_texels());
    }

    TEST_CASE("other data starts over and frees the old volume, also while the worker is busy") {
        SettledMachine m;
        const RID old_volume = m.machine.volume();
        m.propagation = 0.2f;
        REQUIRE(m.step()); // now Lighting
        m.give_data();
        REQUIRE(m.step());
        CHECK(m.machine.stage() == ProbeStage::Lighting);
        CHECK(m.machine.volume() != old_volume);
        CHECK(m.dummy->live().volumes == 1);
        CHECK(m.jobs.size() == 2);
        m.work(); // the old job runs into the void
        m.settle();
        CHECK(m.texels() == m.fresh_texels());
    }

    TEST_CASE("a probe of compressed data shows its blocks, in fewer mips, after any history") {
        SettledMachine m;
        const std::vector<uint8_t> plain = m.texels();
        m.coding = gi::TexelCoding::Dxt5;
        m.give_data();
        m.settle();
        CHECK(m.dummy->volume_desc(m.machine.volume())->mip_count == gi::block_mip_count(m.layout->dims));
        CHECK(m.texels().size() < plain.size());
        m.lights.push_back(lamp(2, {36.0f, 3.0f, 2.0f}));
        m.settle();
        m.lights[0].light.energy = 0.5f;
        m.settle();
        CHECK(has_light(m.texels()));
        CHECK(m.texels() == m.fresh_texels());
    }

    TEST_CASE("data that is taken away leaves an unset probe and no volume") {
        SettledMachine m;
        m.layout.reset();
        ++m.data_version;
        REQUIRE(m.step());
        CHECK(m.machine.stage() == ProbeStage::Unset);
        CHECK(!m.machine.volume());
        CHECK(m.dummy->live().volumes == 0);
        CHECK(!m.machine.is_pending(m.wanted()));
    }

    TEST_CASE("a volume that the rasteriser refuses is reported once and not tried again until there is "
              "other data") {
        Machine m;
        m.give_data();
        m.dummy->fail_next(CallKind::VolumeCreate, {ErrorCode::OutOfMemory, "no room", {}});
        const Status failed = m.step();
        REQUIRE(!failed);
        CHECK(failed.error().message == "no room");
        CHECK(m.machine.stage() == ProbeStage::Unset);
        CHECK(m.step());
        CHECK(m.dummy->calls().empty());
        CHECK(!m.machine.is_pending(m.wanted()));
        m.give_data();
        m.settle();
        CHECK(m.machine.stage() == ProbeStage::Check);
    }

    TEST_CASE("after an upload that failed the next relight sends all texels") {
        SettledMachine m;
        m.lights[0].light.energy = 2.0f;
        REQUIRE(m.step());
        m.work();
        m.dummy->fail_next(CallKind::VolumeUpload, {ErrorCode::IoError, "lost", {}});
        CHECK(!m.step());
        CHECK(m.machine.stage() == ProbeStage::Check);
        CHECK(!m.machine.is_pending(m.wanted())); // no retry without end
        m.propagation = 0.69f;
        m.settle();
        CHECK(m.dummy->count(CallKind::VolumeUpload) == m.all_bricks());
        CHECK(m.texels() == m.fresh_texels());
    }

    TEST_CASE("release() frees the volume at once and the job under way ends in nothing") {
        SettledMachine m;
        m.propagation = 0.2f;
        REQUIRE(m.step());
        m.machine.release(*m.rasterizer);
        CHECK(m.dummy->live() == dummy::LiveCounts{});
        m.work();
        CHECK(m.machine.stage() == ProbeStage::Unset);
    }

    TEST_CASE("each transition is one line in the debug log: probe, from, to, cause") {
        const LogLevel level = log_level();
        set_log_level(LogLevel::Debug);
        std::string text;
        {
            const tests::CapturedStderr captured;
            Machine m;
            m.give_data();
            m.lights = {lamp(1, {30.0f, 4.0f, 4.0f})};
            m.settle();
            m.lights[0].light.color = {1.0f, 0.0f, 0.0f};
            m.propagation = 0.5f;
            m.settle();
            m.give_data();
            REQUIRE(m.step());
            text = captured.text();
        }
        set_log_level(level);
        CHECK(text == "GI probe 7: Unset -> Check (not set up)\n"
                      "GI probe 7: Check -> Lighting (never lit)\n"
                      "GI probe 7: Lighting -> Uploading (lit)\n"
                      "GI probe 7: Uploading -> Check (uploaded)\n"
                      "GI probe 7: Check -> Lighting (propagation changed, light recoloured)\n"
                      "GI probe 7: Lighting -> Uploading (lit)\n"
                      "GI probe 7: Uploading -> Check (uploaded)\n"
                      "GI probe 7: Check -> Unset (data changed)\n"
                      "GI probe 7: Unset -> Check (not set up)\n"
                      "GI probe 7: Check -> Lighting (never lit)\n");
    }
}
