// SPDX-License-Identifier: BSD-3-Clause
#include "resource/test_types.h"

#include "resource/build_context.h"
#include "resource/manager.h"

namespace terrane::test {

namespace {

const Words<Colour> kColourWords{
    {"RED", Colour::red}, {"GREEN", Colour::green}, {"BLUE", Colour::blue}};

template <class T>
std::shared_ptr<T> make(const BuildContext& context, const ElementDescription& d) {
    std::string name = d.tag + " " + (d.name.given ? d.name.value : context.name());
    return std::make_shared<T>(std::move(name), context.manager().services().find<Log>());
}

void declareFruits(Registry& registry) {
    using A = AppleDescription;
    registry.nameInterface<Fruit>("fruit");
    registry.resource<Apple, A, Fruit>("apple", "An attribute of every kind.")
        .attribute("ripe", &A::ripe, "a switch")
        .attribute("visible", &A::visible, "a switch that is on")
        .trueUnlessFalse()
        .attribute("seeds", &A::seeds, "how many")
        .atLeast(0)
        .atMost(20)
        .attribute("weight", &A::weight, "how heavy")
        .unit("kg")
        .above(0)
        .attribute("sugar", &A::sugar, "how sweet")
        .atMost(1)
        .alias("sweetness")
        .attribute("angle", &A::angle, "any number")
        .attribute("shine", &A::shine, "how bright")
        .atLeast(0)
        .atMost(1)
        .clamped()
        .attribute("marks", &A::marks, "bits")
        .bits()
        .attribute("label", &A::label, "any text")
        .attribute("colour", &A::colour, "a word", kColourWords)
        .attribute("sizes", &A::sizes, "integers")
        .attribute("spots", &A::spots, "numbers")
        .above(0)
        .atMost(5)
        .attribute("words", &A::words, "texts")
        .attribute("colours", &A::colours, "words", kColourWords)
        .attribute("target", &A::target, "a target")
        .attribute("file", &A::file, "a file")
        .attribute("friend", &A::friendly, "a fruit")
        .attribute("friends", &A::friends, "fruits")
        .attribute("later", &A::later, "a basket")
        .onDemand()
        .attribute("worm", &A::worm, "a fruit")
        .attribute("smell", &A::smell, "no effect yet")
        .planned()
        .ignored("note", "for people")
        .build([](const A& d, BuildContext& context) -> std::shared_ptr<Apple> {
            if (d.file.given && !context.readSource(d.file->name, d.file.place)) return nullptr;
            return make<Apple>(context, d);
        });
    using P = PearDescription;
    registry.resource<Pear, P, Fruit>("pear", "Needs what it has.")
        .attribute("kind", &P::kind, "a text")
        .required()
        .attribute("next", &P::next, "a fruit")
        .build([](const P& d, BuildContext& context) { return make<Pear>(context, d); });
    registry.planned<Fruit>("mould", "A fruit of a later version.");
}

void declareBaskets(Registry& registry) {
    using B = BasketDescription;
    using L = LidDescription;
    const auto& lid =
        registry.element<L>("lid", "At most one.")
            .attribute("low", &L::low, "lower end")
            .attribute("high", &L::high, "upper end")
            .check([](const L& d, Diagnostics& diagnostics) {
                if (d.low > d.high)
                    diagnostics.error("out-of-range", d.low.place, "'low' is above 'high'");
            })
            .declaration();
    using U = UniformDescription;
    const auto& uniform = registry.element<U>("uniform", "Any tag that starts so.")
                              .prefix({"uniform", "uniform1", "uniform2"})
                              .attribute("name", &U::name, "a text")
                              .required()
                              .attribute("x", &U::x, "a number")
                              .declaration();
    registry.resource<Basket, B>("basket", "One to three fruits.")
        .attribute("favourite", &B::favourite, "a fruit")
        .live()
        .child(lid, 0, 1)
        .child(uniform)
        .children<Fruit>("fruits", 1, 3)
        .build([](const B& d, BuildContext& context) { return make<Basket>(context, d); });
    registry.resource<Basket, B>("shelf", "Anything, by its id; shelves in shelves.")
        .keyedResources("what stands on the shelf")
        .build([](const B& d, BuildContext& context) { return make<Basket>(context, d); });
    registry.resource<Basket, B>("chain", "One that holds itself, for nesting.")
        .children<Basket>("more of them")
        .build([](const B& d, BuildContext& context) { return make<Basket>(context, d); });
    registry.resource<Basket, B>("crate", "Nobody checks it.")
        .lenient()
        .build([](const B& d, BuildContext& context) { return make<Basket>(context, d); });
    registry.resource<Basket, B>("copy", "Its favourite stands for all of it.")
        .attribute("favourite", &B::favourite, "a fruit")
        .standsForAll("favourite")
        .children<Fruit>("fruits")
        .build([](const B& d, BuildContext& context) { return make<Basket>(context, d); });
    registry.topLevel(registry.element<L>("player", "What is played.").declaration());
}

void declareDrawing(Registry& registry) {
    using T = TextureDescription;
    registry.resource<Texture, T>("texture2D", "An image.")
        .attribute("source", &T::source, "a file")
        .attribute("internalformat", &T::format, "a word")
        .required()
        .attribute("width", &T::width, "pixels")
        .atLeast(1)
        .attribute("height", &T::height, "pixels")
        .atLeast(1)
        .attribute("min", &T::min, "a word")
        .attribute("mag", &T::mag, "a word")
        .ignored("format", "a word")
        .ignored("type", "a word")
        .attribute("wraps", &T::wraps, "a word")
        .attribute("wrapt", &T::wrapt, "a word")
        .build([](const T& d, BuildContext& context) -> std::shared_ptr<Texture> {
            if (d.source.given && !context.findFile(d.source->name, d.source.place)) return nullptr;
            return make<Texture>(context, d);
        });
    using M = MeshDescription;
    registry.resource<Mesh, M>("mesh", "A mesh.")
        .attribute("source", &M::source, "a file")
        .required()
        .build([](const M& d, BuildContext& context) -> std::shared_ptr<Mesh> {
            if (!context.findFile(d.source->name, d.source.place)) return nullptr;
            return make<Mesh>(context, d);
        });
    registry.resource<Module, ElementDescription>("module", "A shader.")
        .build([](const ElementDescription& d, BuildContext& context) {
            return make<Module>(context, d);
        });
    using U = ModuleUseDescription;
    const auto& use = registry.element<U>("module", "A module of a program.")
                          .attribute("name", &U::module, "a module")
                          .required()
                          .declaration();
    registry.resource<Program, ElementDescription>("program", "Modules that are linked.")
        .child(use, 1)
        .build([](const ElementDescription& d, BuildContext& context) -> std::shared_ptr<Program> {
            std::string modules;
            for (const Child& child : d.children) {
                const auto& ref = child.as<ModuleUseDescription>()->module;
                if (!ref) return nullptr;
                modules += "+" + ref->name();
            }
            return std::make_shared<Program>(d.tag + modules,
                                             context.manager().services().find<Log>());
        });
}

} // namespace

Logged::Logged(std::string name, Log* log)
    : name_(std::move(name))
    , log_(log) {
    if (log_) log_->lines.push_back("make " + name_);
}

Logged::~Logged() {
    if (log_) log_->lines.push_back("drop " + name_);
}

void declareTestTypes(Registry& registry) {
    declareFruits(registry);
    declareBaskets(registry);
    declareDrawing(registry);
}

} // namespace terrane::test
