// SPDX-License-Identifier: BSD-3-Clause
#include "producer/cpu_tile_storage.h"
#include "producer/gpu_tile_storage.h"
#include "producer/object_tile_storage.h"
#include "render/gl_fixture.h"

#include <doctest/doctest.h>

#include <cstring>
#include <vector>

using namespace terrane;

namespace {

std::vector<unsigned char> layer(const GpuTileStorage::Slot& slot, int level) {
    const int size = std::max(1, slot.texture()->width() >> level);
    const auto bytes =
        slot.texture()->download({.level = level, .z = slot.layer(), .width = size, .height = size},
                                 {TransferFormat::red, TransferType::u8});
    std::vector<unsigned char> result(bytes.size());
    std::memcpy(result.data(), bytes.data(), bytes.size());
    return result;
}

} // namespace

TEST_CASE("Slots are handed out in order, and come back at the end") {
    ObjectTileStorage storage(4);
    CHECK(storage.capacity() == 4);
    CHECK(storage.tileSize() == 0);
    for (int i = 0; i < 4; ++i) {
        CHECK(storage.freeSlots() == 4 - i);
        TileSlot* const slot = storage.newSlot();
        REQUIRE(slot);
        CHECK(slot->index() == i);
        CHECK(slot->allocated());
    }
    CHECK(storage.newSlot() == nullptr);
    for (const int i : {2, 0, 3}) {
        storage.deleteSlot(storage.slot(i));
        CHECK_FALSE(storage.slot(i).allocated());
    }
    for (const int i : {2, 0, 3})
        CHECK(storage.newSlot()->index() == i);
    CHECK(storage.freeSlots() == 0);
}

TEST_CASE("Slots on the CPU hold their data, and how much of it is used") {
    CpuTileStorage<float> storage(5, 3, 2);
    CHECK(storage.tileSize() == 5);
    CHECK(storage.channels() == 3);
    auto& slot = storage.newSlot()->as<CpuFloatTileStorage::Slot>();
    CHECK(slot.capacity() == 75);
    CHECK(slot.size == 75);
    slot.data()[74] = 8;
    slot.size = 10;
    auto& other = storage.newSlot()->as<CpuFloatTileStorage::Slot>();
    CHECK(other.data()[74] == 0);
    CHECK(other.size == 75);
    CHECK(slot.data()[74] == 8);
}

TEST_CASE("A slot for objects keeps the object alive") {
    ObjectTileStorage storage(1);
    auto& slot = storage.newSlot()->as<ObjectTileStorage::Slot>();
    auto object = std::make_shared<std::string>("graph");
    const std::weak_ptr<std::string> watch = object;
    slot.object = std::move(object);
    CHECK(*slot.get<std::string>() == "graph");
    slot.object = std::make_shared<int>(3);
    CHECK(watch.expired());
}

TEST_CASE_FIXTURE(GlFixture, "Tiles on the GPU fill as many array textures as the limit asks for") {
    const GpuTileStorage::Description description{
        .tileSize = 8, .tiles = 10, .format = InternalFormat::r8};
    GpuTileStorage storage(*context, description, 4);
    REQUIRE(storage.textures().size() == 3);
    CHECK(storage.textures()[0]->description().layers == 4);
    CHECK(storage.textures()[2]->description().layers == 2);
    CHECK(storage.tileMap() == nullptr);
    for (int i = 0; i < 10; ++i) {
        const auto& slot = storage.newSlot()->as<GpuTileStorage::Slot>();
        CHECK(slot.texture() == storage.textures()[static_cast<std::size_t>(i / 4)]);
        CHECK(slot.layer() == i % 4);
    }
    CHECK(storage.newSlot() == nullptr);
}

TEST_CASE_FIXTURE(GlFixture, "A tile map needs all tiles in one texture") {
    GpuTileStorage::Description description{
        .tileSize = 8, .tiles = 10, .format = InternalFormat::r8, .tileMap = true};
    CHECK(GpuTileStorage::problem(*context, description, 4) ==
          "a tile map needs all tiles in one texture, which holds 4 at most");
    REQUIRE(GpuTileStorage::problem(*context, description, 100).empty());
    const GpuTileStorage storage(*context, description, 100);
    REQUIRE(storage.tileMap());
    CHECK(storage.tileMap()->width() == 4096);
    CHECK(storage.tileMap()->height() == 8);
}

TEST_CASE_FIXTURE(GlFixture, "The mipmaps of a slot follow its data, and only they") {
    const GpuTileStorage::Description description{
        .tileSize = 4,
        .tiles = 3,
        .format = InternalFormat::r8,
        .sampling = {.min = MinFilter::linearMipmapLinear}};
    GpuTileStorage storage(*context, description, 100);
    const TransferLayout red{TransferFormat::red, TransferType::u8};
    const auto upload = [&](int index, std::vector<unsigned char> texels) {
        storage.slot(index).as<GpuTileStorage::Slot>().upload(red,
                                                              std::as_bytes(std::span(texels)));
    };
    upload(0, std::vector<unsigned char>(16, 40));
    upload(1, {0, 0, 100, 100, 0, 0, 100, 100, 200, 200, 60, 60, 200, 200, 60, 60});
    upload(2, std::vector<unsigned char>(16, 80));
    const auto& slot = storage.slot(1).as<GpuTileStorage::Slot>();
    CHECK(layer(slot, 1) == std::vector<unsigned char>{0, 100, 200, 60});
    CHECK(layer(slot, 2) == std::vector<unsigned char>{90});
    CHECK(layer(storage.slot(0).as<GpuTileStorage::Slot>(), 2) == std::vector<unsigned char>{40});
    CHECK(layer(storage.slot(2).as<GpuTileStorage::Slot>(), 1) ==
          std::vector<unsigned char>(4, 80));
}

TEST_CASE_FIXTURE(GlFixture, "A slot copies what was drawn, whatever the format") {
    for (const InternalFormat format :
         {InternalFormat::rgb32f, InternalFormat::rgba32f, InternalFormat::rg8}) {
        GpuTileStorage storage(*context, {.tileSize = 2, .tiles = 2, .format = format}, 100);
        const auto scratch = std::make_shared<Texture>(
            *context,
            TextureDescription{.format = InternalFormat::rgba32f, .width = 2, .height = 2});
        Framebuffer target(*context);
        target.attach(AttachmentPoint::colour0, {scratch});
        target.setDrawBuffers({AttachmentPoint::colour0});
        target.setReadBuffer(AttachmentPoint::colour0);
        target.state.clear.colour = {0.2f, 0.4f, 0.6f, 0.8f};
        target.clear(Planes::colour);
        auto& slot = storage.slot(1).as<GpuTileStorage::Slot>();
        slot.copyFrom(target);
        const auto bytes = slot.texture()->download({.z = 1, .width = 2, .height = 2},
                                                    {TransferFormat::rgba, TransferType::u8});
        CHECK(std::to_integer<int>(bytes[0]) == 51);
        CHECK(std::to_integer<int>(bytes[13]) == 102);
    }
}
