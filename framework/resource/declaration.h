// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "resource/description.h"
#include "resource/value_traits.h"

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <typeindex>
#include <vector>

/// Declarations: an element type is declared once, next to its class. From this one declaration
/// come parsing, validation, the schema and manual, the inspector and the dependency edges.
///
///     struct LakeDescription : ElementDescription {
///         Attr<float> level = 0;
///         Attr<Shore> shore = Shore::sand;
///         Ref<TileProducer> elevations;
///     };
///
///     void declareLake(Registry& registry) {
///         using D = LakeDescription;
///         registry.resource<Lake, D>("lake", "Water that fills the terrain up to a level.")
///             .attribute("level", &D::level, "height of the water").unit("m").atLeast(0)
///             .attribute("shore", &D::shore, "what the shore is made of", kShoreWords)
///             .attribute("elevations", &D::elevations, "relief to fill").required()
///             .build([](const D& d, BuildContext& context) { return std::make_shared<Lake>(d); });
///     }
///
/// where `inline const Words<Shore> kShoreWords{{"SAND", Shore::sand}, {"ROCK", Shore::rock}};`.
namespace terrane {

class BuildContext;

/// One attribute of an element.
struct AttributeDeclaration {
    std::string name;
    std::string summary;
    ValueKind kind = ValueKind::text;
    std::string defaultText; ///< as it would be written; empty when there is none
    std::string unit;
    bool required = false;
    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();
    bool minimumExcluded = false;
    bool infinite = false;              ///< numbers: infinity is one
    bool clamped = false;               ///< numbers: what is out of range is but a warning
    bool bits = false;                  ///< integers: also what only an unsigned one can hold
    std::vector<std::string> words;     ///< of enumerations
    std::vector<std::string> aliases;   ///< other accepted spellings of the attribute's name
    bool trueUnlessFalse = false;       ///< booleans: any word but "false" is true
    bool otherWordsMeanDefault = false; ///< enumerations: an unknown word is but a warning
    bool onDemand = false; ///< references: loaded by the builder or later, not before it runs
    bool live = false; ///< references: what is built sees the resource of the moment through them
    bool planned = false;                    ///< accepted, but has no effect yet
    std::optional<std::type_index> refersTo; ///< references: interface of the resource

    /// Reads a text into the description. False, with diagnostics, when it can't.
    std::function<bool(const AttributeText&, ElementDescription&, Diagnostics&)> read;
    /// The value as it would be written.
    std::function<std::string(const ElementDescription&)> print;
    /// Places the value of an attribute that is not written.
    std::function<void(ElementDescription&, const Place&)> locate;
    /// Appends the references that the value holds.
    std::function<void(ElementDescription&, std::vector<RefBase*>&)> references;
};

/// Which nested elements are allowed, and how many.
struct ChildRule {
    const ElementDeclaration* element = nullptr; ///< one local element type, or null: resources
    std::optional<std::type_index> provides;     ///< any resource type with this interface
    bool anyResource = false;                    ///< any registered resource type
    bool keyed = false;                          ///< needs an attribute `id`
    std::size_t atLeast = 0;
    std::size_t atMost = std::numeric_limits<std::size_t>::max();
    std::string summary;
};

/// An element type.
struct ElementDeclaration {
    std::string tag;
    bool prefix = false;                ///< matches every tag that starts with `tag`
    std::vector<std::string> knownTags; ///< with a prefix: those that people write, for schemas;
                                        ///< none for an element that only tells a mistake
    std::string summary;
    std::string example; ///< XML that works, for the manual
    std::string chapter; ///< of the manual
    std::vector<AttributeDeclaration> attributes;
    std::vector<ChildRule> childRules;
    bool named = true;            ///< accepts `name` (resources); local elements declare their own
    bool planned = false;         ///< accepted, but not built yet: one warning where it is used
    bool acceptsAnything = false; ///< attributes and children are not checked
    bool lenient = false;         ///< unknown attributes are warnings
    std::string standsForAll;     ///< an attribute beside which children are ignored, and unknown
                                  ///< attributes are warnings

    std::optional<std::type_index> descriptionType;
    std::vector<std::type_index> provides;   ///< class and interfaces of what is built
    std::vector<std::string> interfaceNames; ///< as people read them, for the manual

    std::function<std::shared_ptr<ElementDescription>()> makeDescription;
    /// Rules across attributes, run on a description without other errors. Needs no GL.
    std::function<void(const ElementDescription&, Diagnostics&)> check;
    std::function<std::shared_ptr<Resource>(const ElementDescription&, BuildContext&)> build;

    bool isA(std::type_index interface) const;
    bool matches(std::string_view name) const;
    /// The tag, or those known of a prefix.
    std::vector<std::string> tags() const;
    const AttributeDeclaration* attribute(std::string_view name) const; ///< aliases included
    std::vector<std::string> attributeNames() const;
};

template <class D>
const D* Child::as() const {
    const bool same = declaration && declaration->descriptionType == std::type_index(typeid(D));
    return same ? static_cast<const D*>(description.get()) : nullptr;
}

/// Fluent set-up of an ElementDeclaration. Modifiers concern the attribute declared last.
template <class Derived, class D>
class ElementBuilder {
public:
    explicit ElementBuilder(ElementDeclaration& declaration)
        : declaration_(declaration) {}

    template <class V>
    Derived& attribute(std::string name, V D::*member, std::string summary) {
        AttributeDeclaration& a = add(std::move(name), std::move(summary), ValueTraits<V>::kind);
        ValueTraits<V>::describe(a);
        bind(a, member, typename ValueTraits<V>::Context{});
        return self();
    }
    /// An enumeration, or a list of one, with its words.
    template <class V, class E>
    Derived& attribute(std::string name, V D::*member, std::string summary, const Words<E>& words) {
        AttributeDeclaration& a = add(std::move(name), std::move(summary), ValueTraits<V>::kind);
        for (const auto& word : words)
            a.words.push_back(word.first);
        bind(a, member, words);
        return self();
    }
    /// Accepted and checked for its name only; has no effect (yet).
    Derived& ignored(std::string name, std::string summary) {
        add(std::move(name), std::move(summary), ValueKind::text);
        return self();
    }

    Derived& required() { return last().required = true, self(); }
    Derived& unit(std::string text) { return last().unit = std::move(text), self(); }
    Derived& atLeast(double value) { return last().minimum = value, self(); }
    Derived& above(double value) {
        last().minimumExcluded = true;
        return atLeast(value);
    }
    Derived& atMost(double value) { return last().maximum = value, self(); }
    /// Infinity is a value, too; without this it is out of range.
    Derived& orInfinite() { return last().infinite = true, self(); }
    /// What is out of range counts as the end of the range that is nearest, with a warning: OpenGL,
    /// or the original, did the same without a word.
    Derived& clamped() { return last().clamped = true, self(); }
    /// An int whose bits count: 4294967295 is -1.
    Derived& bits() { return last().bits = true, self(); }
    Derived& alias(std::string name) {
        last().aliases.push_back(std::move(name));
        return self();
    }
    Derived& trueUnlessFalse() { return last().trueUnlessFalse = true, self(); }
    Derived& otherWordsMeanDefault() { return last().otherWordsMeanDefault = true, self(); }
    Derived& onDemand() { return last().onDemand = true, self(); }
    /// Of references that what is built keeps as such, and never what they refer to: it need not be
    /// built anew when that is.
    Derived& live() { return last().live = true, self(); }
    Derived& planned() { return last().planned = true, self(); }

    /// Allows a local element type. `element` must live as long as the registry (see
    /// Registry::element).
    Derived& child(const ElementDeclaration& element, std::size_t atLeast = 0,
                   std::size_t atMost = std::numeric_limits<std::size_t>::max()) {
        declaration_.childRules.push_back({.element = &element,
                                           .atLeast = atLeast,
                                           .atMost = atMost,
                                           .summary = element.summary});
        return self();
    }
    /// Allows any registered resource type that is a T, nested without a name.
    template <class T>
    Derived& children(std::string summary, std::size_t atLeast = 0,
                      std::size_t atMost = std::numeric_limits<std::size_t>::max()) {
        declaration_.childRules.push_back({.provides = std::type_index(typeid(T)),
                                           .atLeast = atLeast,
                                           .atMost = atMost,
                                           .summary = std::move(summary)});
        return self();
    }
    /// Allows any registered resource type, keyed by an attribute `id`.
    Derived& keyedResources(std::string summary) {
        declaration_.childRules.push_back(
            {.anyResource = true, .keyed = true, .summary = std::move(summary)});
        return self();
    }
    /// The tag is a prefix: `uniform` matches `uniform3f`. A schema can't say so, and lists the
    /// tags that are known.
    Derived& prefix(std::vector<std::string> knownTags) {
        declaration_.knownTags = std::move(knownTags);
        return declaration_.prefix = true, self();
    }
    /// For the manual: an element, or several, as an archive may have them.
    Derived& example(std::string xml) { return declaration_.example = std::move(xml), self(); }
    /// Unknown attributes are warnings: the original did not check this element.
    Derived& lenient() { return declaration_.lenient = true, self(); }
    /// Beside this attribute nothing else counts: children are ignored, and unknown attributes are
    /// warnings.
    Derived& standsForAll(std::string attribute) {
        declaration_.standsForAll = std::move(attribute);
        return self();
    }
    /// Rules across attributes.
    Derived& check(std::function<void(const D&, Diagnostics&)> rule) {
        declaration_.check = [rule = std::move(rule)](const ElementDescription& d,
                                                      Diagnostics& diagnostics) {
            rule(static_cast<const D&>(d), diagnostics);
        };
        return self();
    }
    const ElementDeclaration& declaration() const { return declaration_; }

protected:
    ElementDeclaration& declaration_;

private:
    Derived& self() { return static_cast<Derived&>(*this); }
    AttributeDeclaration& last() { return declaration_.attributes.back(); }

    AttributeDeclaration& add(std::string name, std::string summary, ValueKind kind) {
        AttributeDeclaration& a = declaration_.attributes.emplace_back();
        a.name = std::move(name);
        a.summary = std::move(summary);
        a.kind = kind;
        return a;
    }

    template <class V, class Context>
    void bind(AttributeDeclaration& a, V D::*member, Context context) {
        using Traits = ValueTraits<V>;
        const std::size_t index = declaration_.attributes.size() - 1;
        // The declaration is looked up when it is read, since modifiers come after.
        a.read = [&d = declaration_, index, member, context](
                     const AttributeText& text, ElementDescription& e, Diagnostics& diagnostics) {
            return Traits::read(text, d.attributes[index], static_cast<D&>(e).*member, context,
                                diagnostics);
        };
        a.print = [member, context](const ElementDescription& e) {
            return Traits::print(static_cast<const D&>(e).*member, context);
        };
        a.locate = [member](ElementDescription& e, const Place& place) {
            detail::locate(static_cast<D&>(e).*member, place);
        };
        a.references = [member](ElementDescription& e, std::vector<RefBase*>& references) {
            Traits::collect(static_cast<D&>(e).*member, references);
        };
        a.defaultText = Traits::print(D{}.*member, context);
    }
};

/// Builder of an element that exists inside one kind of parent only.
template <class D>
class LocalElementBuilder : public ElementBuilder<LocalElementBuilder<D>, D> {
public:
    using ElementBuilder<LocalElementBuilder<D>, D>::ElementBuilder;
};

/// Builder of a resource type: T is what is built.
template <class T, class D>
class ResourceBuilder : public ElementBuilder<ResourceBuilder<T, D>, D> {
public:
    using ElementBuilder<ResourceBuilder<T, D>, D>::ElementBuilder;

    /// The function that makes the resource, with its references loaded and its nested resources
    /// built. Null, with diagnostics reported to the context, when it can't. On the GL thread.
    ResourceBuilder& build(std::function<std::shared_ptr<T>(const D&, BuildContext&)> function) {
        this->declaration_.build = [function = std::move(function)](const ElementDescription& d,
                                                                    BuildContext& context) {
            return std::shared_ptr<Resource>(function(static_cast<const D&>(d), context));
        };
        return *this;
    }
};

} // namespace terrane
