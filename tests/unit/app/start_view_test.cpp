// SPDX-License-Identifier: BSD-3-Clause
#include "app/start_view.h"

#include "scene/scene_node.h"
#include "terrain/cylindrical_deformation.h"
#include "terrain/spherical_deformation.h"
#include "terrain/terrain_node.h"

#include <doctest/doctest.h>

#include <memory>

using namespace terrane;

namespace {

std::shared_ptr<SceneNode> nodeWith(double size, std::shared_ptr<const Deformation> deformation) {
    auto node = std::make_shared<SceneNode>();
    node->fields["terrain"].owned = std::make_shared<TerrainNode>(
        TerrainNode::Parameters{.size = size, .deformation = std::move(deformation)});
    return node;
}

TerrainNode& terrainOf(const SceneNode& node) {
    return *node.field<TerrainNode>("terrain");
}

} // namespace

TEST_CASE("the first terrain decides how the camera moves and where it starts") {
    SceneNode root;
    root.children.push_back(std::make_shared<SceneNode>());
    SUBCASE("flat") {
        root.children[0]->children.push_back(nodeWith(500, std::make_shared<Deformation>()));
        root.children.push_back(nodeWith(1e6, std::make_shared<SphericalDeformation>(1e6)));
        const auto controller = makeViewController(root);
        CHECK(!dynamic_cast<PlanetViewController*>(controller.get()));
        CHECK(controller->view == View{.d = 500});
    }
    SUBCASE("planet") {
        root.children.push_back(nodeWith(1e6, std::make_shared<SphericalDeformation>(1e6)));
        const auto controller = makeViewController(root);
        const auto* planet = dynamic_cast<PlanetViewController*>(controller.get());
        REQUIRE(planet);
        CHECK(planet->radius() == 1e6);
        CHECK(controller->view == View{.d = 6e6});
    }
    SUBCASE("cylinder") {
        root.children.push_back(nodeWith(300, std::make_shared<CylindricalDeformation>(100)));
        const auto controller = makeViewController(root);
        const auto* cylinder = dynamic_cast<CylinderViewController*>(controller.get());
        REQUIRE(cylinder);
        CHECK(cylinder->radius() == 100);
        CHECK(controller->view == View{.d = 90});
    }
    SUBCASE("no terrain: as far away as the scene is large") {
        root.worldBounds = {{-1, 0, 0}, {1, 8, 3}};
        CHECK(terrainsOf(root).empty());
        CHECK(makeViewController(root)->view == View{.d = 8});
    }
    SUBCASE("an empty scene") {
        CHECK(makeViewController(root)->view == View{.d = 1});
    }
}

TEST_CASE("the ground is that of the terrain below the camera") {
    SceneNode root;
    const auto left = nodeWith(10, nullptr), right = nodeWith(10, nullptr);
    root.children = {left, right};
    const auto look = [](double x) {
        TerrainView view;
        view.localToCamera[3] = {-x, 0, -5, 1};
        view.cameraToScreen = TerrainViewController().cameraToScreen(64, 48);
        return view;
    };
    REQUIRE(terrainOf(*left).update(look(20)));
    REQUIRE(terrainOf(*right).update(look(0)));
    CHECK(terrainBelowCamera(terrainsOf(root)) == &terrainOf(*right));
    REQUIRE(terrainOf(*left).update(look(-9)));
    CHECK(terrainBelowCamera(terrainsOf(root)) == &terrainOf(*left));
    CHECK(terrainBelowCamera(terrainsOf(SceneNode())) == nullptr);
    // Above neither: the first one.
    REQUIRE(terrainOf(*left).update(look(50)));
    REQUIRE(terrainOf(*right).update(look(50)));
    CHECK(terrainBelowCamera(terrainsOf(root)) == &terrainOf(*left));
}
