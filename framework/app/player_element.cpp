// SPDX-License-Identifier: BSD-3-Clause
#include "app/player_element.h"

#include "core/text.h"
#include "resource/library.h"
#include "resource/parser.h"
#include "resource/registry.h"
#include "scene/scene_node.h"

#include <memory>
#include <utility>
#include <vector>

namespace terrane {

namespace {

struct ViewDescription : ElementDescription {
    Attr<std::string> label;
    Attr<double> x0 = 0.0, y0 = 0.0, theta = 0.0, phi = 0.0, d = 1.0;
};

struct PlayerDescription : ElementDescription {
    Ref<SceneNode> root{"scene"};
    Attr<std::string> camera = "camera";
    Attr<std::string> method = "draw";
    Ref<Scheduler> scheduler{"defaultScheduler"};
    Attr<std::string> view;
};

const ElementDeclaration& declareView(Registry& registry) {
    using D = ViewDescription;
    return registry.element<D>("view", "A place to look from; the first one is where play starts.")
        .example(R"(<view name="valley" x0="-20000" y0="12000" theta="1.4" phi="2.094" d="8500"/>)")
        .attribute("name", &D::label, "label by which a player names it")
        .attribute("x0", &D::x0, "x of the point looked at; on a planet, its longitude")
        .unit("m or rad")
        .attribute("y0", &D::y0, "y of the point looked at; on a planet, its latitude")
        .unit("m or rad")
        .attribute("theta", &D::theta, "angle from the vertical; 0 looks straight down")
        .unit("rad")
        .attribute("phi", &D::phi, "azimuth; 0 looks to the north")
        .unit("rad")
        .attribute("d", &D::d, "distance from the point looked at")
        .unit("m")
        .above(0)
        .ignored("key", "key that goes there (not built yet)")
        .ignored("sx", "direction of the sun (not built yet)")
        .ignored("sy", "direction of the sun (not built yet)")
        .ignored("sz", "direction of the sun (not built yet)")
        .declaration();
}

const ElementDeclaration& declarePlayer(Registry& registry, const ElementDeclaration& view) {
    using D = PlayerDescription;
    return registry
        .element<D>("player", "How the archive is to be played. Without it, what is named and "
                              "flagged as the defaults say is.")
        .example(R"(<player root="scene" camera="camera" method="draw">
    <view name="start" theta="1.2" d="5000"/>
</player>)")
        .attribute("root", &D::root, "root node of the scene")
        .attribute("camera", &D::camera, "flag of the camera node")
        .attribute("method", &D::method, "method of the camera node that draws a frame")
        .attribute("scheduler", &D::scheduler, "what runs the tasks of a frame")
        .attribute("view", &D::view, "name of the view to start with; the first one otherwise")
        .ignored("ui", "first event handler (not built yet)")
        .ignored("name", "ignored")
        .child(view)
        .declaration();
}

View viewOf(const ViewDescription& d) {
    return {.x0 = d.x0, .y0 = d.y0, .theta = d.theta, .phi = d.phi, .d = d.d};
}

using Views = std::vector<const ViewDescription*>;

void chooseView(const Views& views, const Attr<std::string>& wanted, PlayerSettings& settings,
                Diagnostics& diagnostics) {
    if (!wanted.given) {
        if (!views.empty()) settings.view = viewOf(*views.front());
        return;
    }
    std::vector<std::string> names;
    for (const ViewDescription* view : views) {
        if (*view->label == *wanted) settings.view = viewOf(*view);
        names.push_back(view->label);
    }
    if (settings.view) return;
    diagnostics.report({.code = "unknown-view",
                        .place = wanted.place,
                        .message = "there is no view '" + *wanted + "'",
                        .expected = names.empty() ? "a <view> in the archive" : listOfNames(names),
                        .suggestion = nearestName(*wanted, names)});
}

} // namespace

void declarePlayerElements(Registry& registry) {
    const ElementDeclaration& view = declareView(registry);
    registry.topLevel(view);
    registry.topLevel(declarePlayer(registry, view));
}

PlayerSettings readPlayerSettings(Library& library, const Registry& registry) {
    Diagnostics& diagnostics = library.diagnostics();
    PlayerSettings settings;
    std::vector<std::shared_ptr<ElementDescription>> kept;
    Views views;
    Attr<std::string> wanted;
    bool hasPlayer = false;
    for (const XmlElement& element : library.entries()) {
        const ElementDeclaration* declaration = registry.findTopLevel(element.tag());
        if (!declaration) continue;
        Child child{declaration, nullptr, nullptr};
        child.description = parseElement(element, *declaration, registry, diagnostics).description;
        kept.push_back(child.description);
        if (const auto* view = child.as<ViewDescription>()) views.push_back(view);
        const auto* player = child.as<PlayerDescription>();
        if (!player) continue;
        if (std::exchange(hasPlayer, true)) {
            diagnostics.warning("too-many-elements", player->place,
                                "there is another <player> already", "one at most");
            continue;
        }
        // A default is placed at the element.
        settings.rootGiven = player->root.place != player->place;
        settings.schedulerGiven = player->scheduler.place != player->place;
        settings.root = player->root;
        settings.camera = player->camera;
        settings.method = player->method;
        settings.scheduler = player->scheduler;
        wanted = player->view;
        for (const Child& nested : player->children) {
            if (const auto* view = nested.as<ViewDescription>()) views.push_back(view);
        }
    }
    chooseView(views, wanted, settings, diagnostics);
    return settings;
}

} // namespace terrane
