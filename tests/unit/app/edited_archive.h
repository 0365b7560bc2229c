// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "archive_folder.h"

#include "app/player.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

/// A small archive that has something of everything, to be edited while a player has it open:
/// residuals from a file -> elevations -> normals, as a branch beside them other elevations with
/// shaders of their own, a texture, a mesh, a font, and shaders of which some share an include.
class EditedArchive {
public:
    /// What all entries are named in the tests.
    static constexpr const char* kProducers[] = {"residuals", "elevations", "normals", "branch"};

    explicit EditedArchive(PlayerOptions options = {});

    /// Loads, and draws until the picture is complete.
    Player& open();
    Player& player() { return *player_; }

    /// Replaces the first place of a text in a file; the text must be there.
    void edit(const std::string& file, std::string_view before, std::string_view after);
    void write(const std::string& file, std::string_view bytes) { folder_.file(file, bytes); }
    std::string read(const std::string& file) const;
    void remove(const std::string& file);
    /// Fills the texture that the ground is tinted with.
    void paintTint(unsigned char r, unsigned char g, unsigned char b);
    const std::filesystem::path& path() const { return folder_.path(); }

    /// The picture, once it is complete.
    Image picture();
    /// That of another player that opens the archive as it is now, with the same view and clock.
    Image freshPicture();
    /// Codes of the player's problems, with a blank behind each.
    std::string problems() const;

private:
    PlayerOptions options() const;

    ArchiveFolder folder_;
    PlayerOptions options_;
    std::unique_ptr<Player> player_;
};

bool samePicture(const Image& a, const Image& b);

/// The names, with a blank behind each.
std::string listed(const std::vector<std::string>& names);

} // namespace terrane
