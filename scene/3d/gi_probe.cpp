#include "scene/3d/gi_probe.h"

#include "core/object/class_registry.h"

#include <utility>

namespace cl::scene {

void GIProbe::bind(ClassBuilder<GIProbe>& c) {
    c.doc("Box that receives indirect light.");
    c.enumeration("Subdiv", {{"SUBDIV_64", 0}, {"SUBDIV_128", 1}, {"SUBDIV_256", 2}, {"SUBDIV_512", 3}});
    c.property("subdiv", &GIProbe::subdiv, &GIProbe::set_subdiv)
        .doc("Leaf cells along the longest axis: 64, 128, 256 or 512.")
        .enumeration("64,128,256,512")
        .default_value(1);
    c.property("extents", &GIProbe::extents, &GIProbe::set_extents)
        .doc("Half size of the box [m].")
        .default_value(glm::vec3(10.0f));
    c.property("dynamic_range", &GIProbe::dynamic_range, &GIProbe::set_dynamic_range)
        .doc("Radiance that the brightest texel stands for. Takes effect at the next bake.")
        .range("1,16,1")
        .default_value(4);
    c.property("energy", &GIProbe::energy, &GIProbe::set_energy)
        .doc("Factor on the indirect light.")
        .range("0,16,0.01,or_greater")
        .default_value(1.0);
    c.property("propagation", &GIProbe::propagation, &GIProbe::set_propagation)
        .doc("How far light keeps its strength: 0 averages over empty space, 1 over occupied cells only.")
        .range("0,1,0.01")
        .default_value(0.7);
    c.property("bias", &GIProbe::bias, &GIProbe::set_bias)
        .doc("Where cones start [leaf cells].")
        .range("0,4,0.001")
        .default_value(1.5);
    c.property("normal_bias", &GIProbe::normal_bias, &GIProbe::set_normal_bias)
        .doc("Moves the cones' start along the normal [m].")
        .range("0,4,0.001")
        .default_value(0.0);
    c.property("interior", &GIProbe::is_interior, &GIProbe::set_interior)
        .doc("Ambient light and sky do not reach what the cones miss.")
        .default_value(false);
    c.property("compress", &GIProbe::is_compressed, &GIProbe::set_compress)
        .doc("Shows the texture as S3TC blocks would keep it, coarser in colour.")
        .default_value(false);
    c.property("data", &GIProbe::data, &GIProbe::set_data).doc("What was baked.").default_value(Variant());
}

GIProbe::GIProbe() {
    ignore_scale();
}

SetResult GIProbe::set_subdiv(GIProbeSubdiv subdiv) {
    if (subdiv > GIProbeSubdiv::Cells512) {
        return SetResult::Refused;
    }
    subdiv_ = subdiv;
    return SetResult::Done;
}

SetResult GIProbe::set_dynamic_range(int range) {
    if (range < 1) {
        return SetResult::Refused; // it divides
    }
    dynamic_range_ = range;
    return SetResult::Done;
}

void GIProbe::set_energy(float energy) {
    energy_ = energy;
    if (data_) {
        data_->set_energy(energy);
    }
}

void GIProbe::set_propagation(float propagation) {
    propagation_ = propagation;
    if (data_) {
        data_->set_propagation(propagation);
    }
}

void GIProbe::set_bias(float bias_cells) {
    bias_cells_ = bias_cells;
    if (data_) {
        data_->set_bias(bias_cells);
    }
}

void GIProbe::set_normal_bias(float normal_bias_m) {
    normal_bias_m_ = normal_bias_m;
    if (data_) {
        data_->set_normal_bias(normal_bias_m);
    }
}

void GIProbe::set_interior(bool interior) {
    interior_ = interior;
    if (data_) {
        data_->set_interior(interior);
    }
}

void GIProbe::set_compress(bool compress) {
    compress_ = compress;
    if (data_) {
        data_->set_compress(compress);
    }
}

void GIProbe::set_data(Ref<GIProbeData> data) {
    const Ref<GIProbeData> old =
        std::exchange(data_, std::move(data)); // keeps its RID until the server let go
    restart_base();
}

RID GIProbe::base_rid(VisualServer& server) {
    return data_ ? data_->rid(server) : RID{};
}

void GIProbe::copy_state_from(const Node& original) {
    VisualInstance::copy_state_from(original);
    if (data_) { // not shared between copies: each has its own light
        auto own = make_ref<GIProbeData>();
        own->set_data(data_->data());
        set_data(std::move(own));
    }
}

Expected<BakeFigures> GIProbe::bake(const Node* from, const gi::BakeProgress& progress, BakeFor purpose) {
    const Node* start = from ? from : parent() ? parent() : this;
    BakeRequest request{
        .extents_m = extents_m_,
        .subdivision = 64 << static_cast<int>(subdiv_),
        .world_from_probe = global_transform(),
    };
    if (purpose == BakeFor::Once) {
        memory_.reset();
    } else {
        if (!memory_) {
            memory_ = std::make_unique<BakeMemory>();
        }
        request.memory = memory_.get();
        if (data_ && data_->cells_version() == remembered_version_) {
            request.last_result = data_->data().dynamic_data;
        }
    }
    Expected<BakeResult> result = bake_probe(*start, request, progress);
    if (!result) {
        return result.error();
    }
    gi::ProbeData& baked = result->data;
    baked.dynamic_range = dynamic_range_;
    baked.energy = energy_;
    baked.bias_cells = bias_cells_;
    baked.normal_bias_m = normal_bias_m_;
    baked.propagation = propagation_;
    baked.interior = interior_;
    baked.compress = compress_;
    const Ref<GIProbeData> target = data_ ? data_ : make_ref<GIProbeData>();
    target->set_data(std::move(baked));
    set_data(target);
    remembered_version_ = target->cells_version();
    return result->figures;
}

} // namespace cl::scene
