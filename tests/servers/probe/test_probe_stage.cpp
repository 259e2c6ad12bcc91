#include "servers/probe/probe_stage.h"

#include <doctest/doctest.h>

#include <set>
#include <utility>

using namespace cl;

TEST_SUITE("servers/probe/probe_stage") {
    TEST_CASE("no stage has two transitions for one signal, and each can be looked up") {
        std::set<std::pair<ProbeStage, ProbeSignal>> seen;
        for (const ProbeTransition& t : kProbeTransitions) {
            CAPTURE(to_string(t.from));
            CAPTURE(to_string(t.on));
            CHECK(seen.insert({t.from, t.on}).second);
            CHECK(&probe_transition(t.from, t.on) == &t);
        }
    }

    TEST_CASE("a transition that stays where it is does nothing: doing and waiting are never mixed") {
        for (const ProbeTransition& t : kProbeTransitions) {
            if (t.from == t.to) {
                CHECK(t.action == ProbeAction::None);
            }
        }
    }

    TEST_CASE("from every stage each other one can be reached") {
        for (ProbeStage start :
             {ProbeStage::Unset, ProbeStage::Check, ProbeStage::Lighting, ProbeStage::Uploading}) {
            std::set<ProbeStage> reached{start};
            for (size_t round = 0; round < 4; ++round) {
                for (const ProbeTransition& t : kProbeTransitions) {
                    if (reached.contains(t.from)) {
                        reached.insert(t.to);
                    }
                }
            }
            CHECK(reached.size() == 4);
        }
    }

    TEST_CASE("other data starts a probe over, at rest and while the worker is busy") {
        for (ProbeStage stage : {ProbeStage::Check, ProbeStage::Lighting}) {
            const ProbeTransition& t = probe_transition(stage, ProbeSignal::DataChanged);
            CHECK(t.to == ProbeStage::Unset);
            CHECK(t.action == ProbeAction::StartOver);
        }
    }
}
