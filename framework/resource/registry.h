// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/declaration.h"

#include <deque>
#include <map>
#include <string>
#include <string_view>

namespace terrane {

/// A part of the reference manual.
struct Chapter {
    std::string title;
    std::string summary; ///< Markdown
};

/// All element types that archives may use, filled by explicit calls (registerStandardTypes and
/// those of plugins). A tag declared again replaces the earlier one. Immutable once players use it,
/// so any thread may read it and several players may share it.
class Registry {
public:
    Registry() = default;
    Registry(const Registry&) = delete;
    Registry& operator=(const Registry&) = delete;

    /// Declares a resource type T, also usable as each of `Interfaces` (its base classes).
    template <class T, class D, class... Interfaces>
    ResourceBuilder<T, D> resource(std::string tag, std::string summary) {
        ElementDeclaration& d = add(tag);
        d = declared(std::move(tag), std::move(summary));
        d.provides = {std::type_index(typeid(T)), std::type_index(typeid(Interfaces))...,
                      std::type_index(typeid(Resource))};
        describe<D>(d);
        return ResourceBuilder<T, D>(d);
    }
    /// Declares an element type that stands inside other elements only; pass it to child().
    template <class D>
    LocalElementBuilder<D> element(std::string tag, std::string summary) {
        ElementDeclaration& d = locals_.emplace_back();
        d = declared(std::move(tag), std::move(summary));
        d.named = false;
        describe<D>(d);
        return LocalElementBuilder<D>(d);
    }
    /// Declares a resource type that a later version builds: accepted with a warning, and left out
    /// of what uses it.
    template <class... Interfaces>
    void planned(std::string tag, std::string summary) {
        ElementDeclaration& d = add(tag);
        d = declared(std::move(tag), std::move(summary));
        d.planned = d.acceptsAnything = true;
        d.provides = {std::type_index(typeid(Interfaces))...};
        describe<ElementDescription>(d);
    }
    /// Allows a local element type directly below the root of an archive, beside the resources.
    void topLevel(const ElementDeclaration& declaration) { topLevel_.push_back(&declaration); }
    /// What is declared from here on stands in this chapter of the manual. The first call with a
    /// title says what the chapter is about.
    void chapter(const std::string& title, std::string summary = {});
    /// In the order of their first calls.
    const std::vector<Chapter>& chapters() const { return chapters_; }
    /// The word people use for an interface ("producer"), for messages and the manual.
    template <class T>
    void nameInterface(std::string name) {
        interfaceNames_[std::type_index(typeid(T))] = std::move(name);
    }

    const ElementDeclaration* find(std::string_view tag) const;
    /// Those that stand directly below the root of an archive and are no resources.
    const std::vector<const ElementDeclaration*>& topLevels() const { return topLevel_; }
    const ElementDeclaration* findTopLevel(std::string_view tag) const;
    std::vector<std::string> tags() const;
    /// Tags of what may stand directly below the root of an archive.
    std::vector<std::string> entryTags() const;
    /// Tags of the types with an interface.
    std::vector<std::string> tagsOf(std::type_index interface) const;
    /// "producer", else "'a', 'b' or 'c'".
    std::string describeInterface(std::type_index interface) const;
    /// The word alone; empty when there is none.
    std::string interfaceName(std::type_index interface) const;

private:
    ElementDeclaration declared(std::string tag, std::string summary) const;
    template <class D>
    static void describe(ElementDeclaration& d) {
        d.descriptionType = std::type_index(typeid(D));
        d.makeDescription = [] { return std::make_shared<D>(); };
    }
    ElementDeclaration& add(const std::string& tag) { return types_[tag]; }

    std::map<std::string, ElementDeclaration, std::less<>> types_;
    std::deque<ElementDeclaration> locals_;
    std::vector<const ElementDeclaration*> topLevel_;
    std::map<std::type_index, std::string> interfaceNames_;
    std::vector<Chapter> chapters_;
    std::string chapter_; ///< that of now
};

} // namespace terrane
