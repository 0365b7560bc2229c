// SPDX-License-Identifier: BSD-3-Clause
#include "core/text.h"
#include "render/initial_uniform_elements.h"
#include "render/mesh.h"
#include "render/module.h"
#include "render/texture.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"
#include "scene/scene_node.h"
#include "scene/scene_task.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace terrane {

namespace {

constexpr std::size_t kMostNodes = 100000;

struct TranslateDescription : ElementDescription {
    Attr<double> x = 0, y = 0, z = 0;
};

struct RotateDescription : ElementDescription {
    Attr<double> angle = 0;
};

struct BoundsDescription : ElementDescription {
    Attr<double> xmin, xmax, ymin, ymax, zmin, zmax;
};

struct ValueDescription : ElementDescription {
    Attr<std::string> key;
    Attr<double> x, y, z, w;
    Attr<std::string> type = "FLOAT";
    Ref<Texture> texture;
};

template <class T>
struct KeyedDescription : ElementDescription {
    Attr<std::string> key;
    Ref<T> value;
};

struct MethodDescription : ElementDescription {
    Attr<std::string> key;
    Ref<SceneTask> value;
    Attr<bool> enabled = true;
};

struct NodeDescription : ElementDescription {
    Attr<std::vector<std::string>> flags;
    Ref<SceneNode> value;
};

glm::dvec3 axis(const std::string& tag) {
    return {tag.back() == 'x', tag.back() == 'y', tag.back() == 'z'};
}

void checkValue(const ValueDescription& d, Diagnostics& diagnostics) {
    const std::vector<std::string> types{"FLOAT", "DOUBLE", "INT", "UINT", "BOOL"};
    if (std::find(types.begin(), types.end(), *d.type) == types.end()) {
        diagnostics.report({.severity = Severity::warning,
                            .code = "unknown-word",
                            .place = d.type.place,
                            .message = inQuotes(*d.type) + " counts as 'DOUBLE'",
                            .expected = listOfNames(types),
                            .suggestion = nearestName(*d.type, types)});
    }
    if (d.x.given || d.texture.given()) return;
    diagnostics.error("missing-attribute", d.place, "<" + d.tag + "> needs a value",
                      "'x' (and 'y', 'z', 'w'), or 'texture'");
}

NodeValue valueOf(const ValueDescription& d) {
    NodeValue value;
    value.place = d.key.place;
    if (!d.x.given) {
        value.type = NodeValue::Type::sampler;
        value.texture = d.texture;
        return value;
    }
    // The number of components in a row decides, not the digit of the tag.
    const Attr<double>* const components[] = {&d.x, &d.y, &d.z, &d.w};
    while (value.components < 4 && components[value.components]->given) {
        value.value[value.components] = components[value.components]->value;
        ++value.components;
    }
    const std::string& type = *d.type;
    value.type = type == "FLOAT"  ? NodeValue::Type::floats
                 : type == "INT"  ? NodeValue::Type::integers
                 : type == "UINT" ? NodeValue::Type::unsignedIntegers
                 : type == "BOOL" ? NodeValue::Type::booleans
                                  : NodeValue::Type::doubles;
    return value;
}

// Names of nodes in lists keep their blanks, as the original had it.
void checkFlags(const NodeDescription& d, Diagnostics& diagnostics) {
    detail::ValueWalker walker(d.flags.place);
    for (const std::string& flag : *d.flags) {
        if (flag.empty() || flag.front() == ' ' || flag.back() == ' ') {
            diagnostics.warning("blank-in-name", walker.place(),
                                flag.empty() ? "an empty flag"
                                             : "the blanks of " + inQuotes(flag) + " belong to it",
                                "flags with nothing but a comma between them");
        }
        walker.advance(flag.size() + 1);
    }
}

// Adds what a child element says, in document order: a matrix multiplies what came before, bounds
// replace the box and meshes enlarge it.
class NodeMaker {
public:
    NodeMaker(SceneNode& node, Diagnostics& diagnostics)
        : node_(node)
        , diagnostics_(diagnostics) {}

    void add(const Child& child) {
        if (auto* t = child.as<TranslateDescription>())
            node_.localToParent = glm::translate(node_.localToParent, {*t->x, *t->y, *t->z});
        else if (auto* r = child.as<RotateDescription>())
            node_.localToParent =
                glm::rotate(node_.localToParent, glm::radians(*r->angle), axis(r->tag));
        else if (auto* b = child.as<BoundsDescription>())
            node_.localBounds = {{*b->xmin, *b->ymin, *b->zmin}, {*b->xmax, *b->ymax, *b->zmax}};
        else if (auto* value = child.as<ValueDescription>())
            node_.values.emplace(*value->key, valueOf(*value));
        else
            addResource(child);
    }

private:
    // What could not be had is kept as an empty reference: methods that use it fail silently, since
    // it has been told here.
    void addResource(const Child& child) {
        if (auto* module = child.as<KeyedDescription<Module>>()) {
            node_.modules[*module->key] = module->value;
        } else if (auto* mesh = child.as<KeyedDescription<Mesh>>()) {
            addMesh(*mesh);
        } else if (auto* field = child.as<KeyedDescription<Resource>>()) {
            node_.fields[*field->key] = {field->value, nullptr};
        } else if (auto* method = child.as<MethodDescription>()) {
            node_.methods[*method->key] = {method->value, *method->enabled};
        } else if (auto node = child.built<SceneNode>()) {
            addChild(std::move(node), child.description->place);
        } else if (child.description->id.given) {
            node_.fields[*child.description->id] = {{}, child.resource};
        }
    }

    // A node may be used several times; used twice at each of thirty levels it would be a billion.
    void addChild(std::shared_ptr<SceneNode> node, const Place& place) {
        if (node_.size + node->size > kMostNodes) {
            diagnostics_.error("too-many", place,
                               "the scene has more than " + std::to_string(kMostNodes) +
                                   " nodes, those that are used several times counted each time",
                               "fewer references to nodes");
            return;
        }
        node_.size += node->size;
        node_.children.push_back(std::move(node));
    }

    void addMesh(const KeyedDescription<Mesh>& mesh) {
        node_.meshes[*mesh.key] = mesh.value;
        if (!mesh.value) return;
        node_.localBounds =
            node_.localBounds.enlarged({mesh.value->boundsMin(), mesh.value->boundsMax()});
    }

    SceneNode& node_;
    Diagnostics& diagnostics_;
};

std::shared_ptr<SceneNode> buildNode(const NodeDescription& d, BuildContext& context) {
    // A reference to another node: everything else that it says is ignored.
    if (d.value.given()) return std::static_pointer_cast<SceneNode>(d.value.entry()->instance);
    auto node = std::make_shared<SceneNode>();
    node->place = d.place;
    node->name = *d.name;
    node->flags = *d.flags;
    if (d.flags.given) node->flagsPlace = d.flags.place;
    if (!node->name.empty()) node->flags.push_back(node->name);
    NodeMaker maker(*node, context.diagnostics());
    for (const Child& child : d.children)
        maker.add(child);
    node->described = node->localToParent;
    // Where somebody has moved it, such as the light, it stays unless the archive moves it.
    const auto previous = context.previous<SceneNode>();
    if (previous && previous->described == node->described)
        node->localToParent = previous->localToParent;
    return node;
}

template <class T>
LocalElementBuilder<KeyedDescription<T>> declareKeyed(Registry& registry, const char* tag,
                                                      const char* summary, const char* value) {
    using D = KeyedDescription<T>;
    return registry.element<D>(tag, summary)
        .attribute("id", &D::key, "key that methods use")
        .required()
        .attribute("value", &D::value, value)
        .required();
}

const ElementDeclaration& declareValue(Registry& registry) {
    using D = ValueDescription;
    std::vector<std::string> tags = vectorUniformTags();
    tags.push_back("uniformSampler");
    return registry.element<D>("uniform", "A value that setProgram hands to shaders.")
        .prefix(std::move(tags))
        .attribute("id", &D::key, "key, and name of the uniform")
        .required()
        .attribute("x", &D::x, "first component; without it, the value is a texture")
        .orInfinite()
        .attribute("y", &D::y, "second component")
        .orInfinite()
        .attribute("z", &D::z, "third component")
        .orInfinite()
        .attribute("w", &D::w, "fourth component")
        .orInfinite()
        .attribute("type", &D::type, "BOOL, INT, UINT, FLOAT or DOUBLE, as does any other word")
        .attribute("texture", &D::texture, "texture of a sampler value")
        .live()
        .ignored("name", "ignored")
        .ignored("sampler", "ignored")
        .check(checkValue)
        .declaration();
}

const ElementDeclaration& declareMethod(Registry& registry) {
    using D = MethodDescription;
    return registry.element<D>("method", "Something that the node does when it is called.")
        .attribute("id", &D::key, "key that callMethod uses")
        .required()
        .attribute("value", &D::value, "the task that the method runs, mostly a sequence")
        .required()
        .live()
        .attribute("enabled", &D::enabled, "whether calls run it")
        .trueUnlessFalse()
        .declaration();
}

const ElementDeclaration& declareRotation(Registry& registry, const char* tag) {
    using D = RotateDescription;
    return registry.element<D>(tag, "Rotates what comes after it.")
        .attribute("angle", &D::angle, "angle, counter-clockwise seen from the tip of the axis")
        .unit("degrees")
        .declaration();
}

const ElementDeclaration& declareTranslation(Registry& registry) {
    using D = TranslateDescription;
    return registry.element<D>("translate", "Moves what comes after it.")
        .attribute("x", &D::x, "offset to the east")
        .attribute("y", &D::y, "offset to the north")
        .attribute("z", &D::z, "offset upwards")
        .declaration();
}

const ElementDeclaration& declareBounds(Registry& registry) {
    using D = BoundsDescription;
    return registry.element<D>("bounds", "Replaces the node's bounding box.")
        .attribute("xmin", &D::xmin, "west side")
        .required()
        .attribute("xmax", &D::xmax, "east side")
        .required()
        .attribute("ymin", &D::ymin, "south side")
        .required()
        .attribute("ymax", &D::ymax, "north side")
        .required()
        .attribute("zmin", &D::zmin, "bottom")
        .required()
        .attribute("zmax", &D::zmax, "top")
        .required()
        .declaration();
}

} // namespace

void declareSceneNode(Registry& registry) {
    using D = NodeDescription;
    registry.nameInterface<SceneNode>("a node");
    auto node = registry.resource<SceneNode, D>(
        "node", "A node of the scene: a place, what hangs at it, and what it can do.");
    node.example(R"(<node name="ground" flags="object">
    <bounds xmin="-5000" xmax="5000" ymin="-5000" ymax="5000" zmin="0" zmax="900"/>
    <field id="terrain" value="groundTerrain"/>
    <tileSampler id="heights" sampler="elevationSampler" producer="elevations"/>
    <module id="material" value="groundModule"/>
    <mesh id="grid" value="gridskirt.mesh"/>
    <method id="update" value="updateGround"/>
    <method id="draw" value="drawGround"/>
</node>)")
        .attribute("flags", &D::flags, "words by which methods find the node")
        .attribute("value", &D::value, "in a nested node: the node to use instead of this one")
        .standsForAll("value")
        .check(checkFlags)
        .child(declareTranslation(registry))
        .child(declareRotation(registry, "rotatex"))
        .child(declareRotation(registry, "rotatey"))
        .child(declareRotation(registry, "rotatez"))
        .child(declareBounds(registry))
        .child(declareValue(registry))
        .child(declareKeyed<Module>(registry, "module",
                                    "A shader of the node, by the key that methods use.",
                                    "the module")
                   .live()
                   .lenient()
                   .declaration())
        .child(declareKeyed<Mesh>(registry, "mesh",
                                  "A mesh of the node, by the key that methods use; its bounding "
                                  "box enlarges the node's.",
                                  "the mesh")
                   .declaration())
        .child(declareKeyed<Resource>(
                   registry, "field",
                   "Any resource, by the key that methods use, such as a terrain.", "the resource")
                   .live()
                   .declaration())
        .child(declareMethod(registry))
        .child(node.declaration())
        .keyedResources("any other resource, nested, kept at the node as a field")
        .build(buildNode);
}

} // namespace terrane
