// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/registry.h"

#include <string>
#include <vector>

/// A small world of element types that has one of everything a declaration can say. The unit tests
/// and the fuzz target of archives read it.
namespace terrane::test {

/// What was built and destroyed, in order; a service that tests may provide.
struct Log {
    std::vector<std::string> lines;
};

/// Something that tells the log when it is made and when it goes.
class Logged : public Resource {
public:
    Logged(std::string name, Log* log);
    ~Logged() override;
    const std::string& name() const { return name_; }

private:
    std::string name_;
    Log* log_;
};

/// An interface, and two classes that have it.
class Fruit : public Logged {
public:
    using Logged::Logged;
};
class Apple : public Fruit {
public:
    using Fruit::Fruit;
};
class Pear : public Fruit {
public:
    using Fruit::Fruit;
};
class Basket : public Logged {
public:
    using Logged::Logged;
};
class Texture : public Logged {
public:
    using Logged::Logged;
};
class Mesh : public Logged {
public:
    using Logged::Logged;
};
class Module : public Logged {
public:
    using Logged::Logged;
};
class Program : public Logged {
public:
    using Logged::Logged;
};

enum class Colour { red, green, blue };

/// `apple`: an attribute of every kind.
struct AppleDescription : ElementDescription {
    Attr<bool> ripe = false;
    Attr<bool> visible = true; // true unless "false"
    Attr<int> seeds = 5;       // 0 to 20
    Attr<double> weight = 0.5; // more than 0
    Attr<float> sugar = 0.1f;  // at most 1
    Attr<float> angle = 0;     // any
    Attr<float> shine = 0.5F;  // clamped to 0 to 1
    Attr<int> marks = 0;       // bits
    Attr<std::string> label = "plain";
    Attr<std::string> smell;
    Attr<Colour> colour = Colour::green;
    Attr<std::vector<int>> sizes;
    Attr<std::vector<float>> spots; // more than 0, at most 5
    Attr<std::vector<std::string>> words;
    Attr<std::vector<Colour>> colours;
    Attr<Target> target;
    Attr<DataFile> file;
    Ref<Fruit> friendly;
    RefList<Fruit> friends;
    Ref<Basket> later; // on demand
    Ref<Fruit> worm;   // refers to a planned type in tests
};

/// `pear`: needs an attribute and a reference.
struct PearDescription : ElementDescription {
    Attr<std::string> kind;
    Ref<Fruit> next;
};

/// Stands in a basket: at most one lid, bounds with a rule across attributes.
struct LidDescription : ElementDescription {
    Attr<float> low = 0.f;
    Attr<float> high = 1.f;
};
struct UniformDescription : ElementDescription {
    Attr<std::string> name;
    Attr<float> x = 0.f;
};
struct ModuleUseDescription : ElementDescription {
    Ref<Module> module;
};
/// `basket`: one to three fruits, a lid, uniforms, anything with an `id` in a `shelf`.
struct BasketDescription : ElementDescription {
    Ref<Fruit> favourite = Ref<Fruit>("");
};
struct TextureDescription : ElementDescription {
    Attr<DataFile> source;
    Attr<int> width = 0;
    Attr<int> height = 0;
    Attr<std::string> format;
    Attr<std::string> min, mag, wraps, wrapt;
};
struct MeshDescription : ElementDescription {
    Attr<DataFile> source;
};

/// apple, pear, basket, shelf, mould (planned), chain; texture2D, mesh, module, program as far as
/// names need them; player (top level).
void declareTestTypes(Registry& registry);

} // namespace terrane::test
