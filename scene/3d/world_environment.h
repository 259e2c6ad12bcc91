#pragma once

#include "scene/main/node.h"
#include "scene/resources/environment.h"

namespace cl::scene {

/// Gives the tree's world its environment. With several, the one that entered the tree last counts.
class WorldEnvironment final : public Node {
public:
    static constexpr std::string_view kClassName = "WorldEnvironment";
    static void bind(ClassBuilder<WorldEnvironment>& c);

    [[nodiscard]] const Ref<Environment>& environment() const noexcept { return environment_; }
    void set_environment(Ref<Environment> environment);

protected:
    void notification(Notification what) override;

private:
    Ref<Environment> environment_;
};

} // namespace cl::scene
