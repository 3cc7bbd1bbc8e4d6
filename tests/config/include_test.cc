// Sections that include keys from other files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "lib/config/config.h"
#include "tests/config/messages.h"

namespace orthodyn::include_test {
namespace {

class Include : public ::testing::Test {
 protected:
  Include() {
    std::filesystem::create_directories(folder_ / "parts");
    write("parts/wood.yaml", "density: 450\nyoung: [3, 2, 1]\nmesh: {file: wood.msh, scale: 2}\n");
  }
  ~Include() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::string place(const std::string& name) const { return (folder_ / name).string(); }
  Config read(const std::string& text) const {
    write("scene.yaml", text);
    return Config::from_file(place("scene.yaml"));
  }

  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(Include, BringsTheKeysOfAnotherFile) {
  const Config c = read("a: {include: parts/wood.yaml}\n");
  EXPECT_EQ(c.at("a").at("density").number(), 450);
  EXPECT_FALSE(c.at("a").has("include"));
}

TEST_F(Include, WhatTheSectionSaysItselfWins) {
  const Config c = read("a:\n  include: parts/wood.yaml\n  density: 7\n  mesh: {scale: 3}\n");
  EXPECT_EQ(c.at("a").at("density").number(), 7);
  EXPECT_EQ(c.at("a").at("mesh").at("scale").number(), 3);
  EXPECT_EQ(c.at("a").at("mesh").at("file").text(), "wood.msh");
}

TEST_F(Include, LaterFilesWinOverEarlierOnes) {
  write("other.yaml", "density: 8\n");
  EXPECT_EQ(read("include: [parts/wood.yaml, other.yaml]\n").at("density").number(), 8);
  EXPECT_EQ(read("include: [other.yaml, parts/wood.yaml]\n").at("density").number(), 450);
}

TEST_F(Include, AMessageNamesTheFileThatHoldsTheValue) {
  const Config c = read("own: 1\na:\n  include: parts/wood.yaml\n  mesh: {scale: 3}\n");
  EXPECT_EQ(c.at("a").at("young").at(1).where(), place("parts/wood.yaml") + ":2:12: a.young.1");
  EXPECT_EQ(c.at("a").at("mesh").at("file").where(), place("parts/wood.yaml") + ":3:14: a.mesh.file");
  EXPECT_EQ(c.at("a").at("mesh").at("scale").where(), place("scene.yaml") + ":4:17: a.mesh.scale");
  EXPECT_EQ(c.at("own").where(), place("scene.yaml") + ":1:6: own");
}

TEST_F(Include, FilesNestAndEachIsNamed) {
  write("parts/outer.yaml", "include: wood.yaml\nyoung: [9, 9, 9]\n");
  const Config c = read("include: parts/outer.yaml\n");
  EXPECT_EQ(c.at("density").where(), place("parts/wood.yaml") + ":1:10: density");
  EXPECT_EQ(c.at("young").where(), place("parts/outer.yaml") + ":2:8: young");
}

TEST_F(Include, FilesAreFoundFromTheFileThatNamesThem) {
  const Config c = read("include: parts/wood.yaml\n");
  EXPECT_EQ(c.at("mesh").at("file").file_path(), place("parts/wood.msh"));
}

TEST_F(Include, ValuesFromTheCommandLineWin) {
  Config c = read("include: parts/wood.yaml\n");
  c.override_with("density=3");
  EXPECT_EQ(c.at("density").number(), 3);
  EXPECT_TRUE(holds(c.at("density").where(), "--set density"));
}

TEST_F(Include, AMissingFileIsNamedWithItsPlace) {
  EXPECT_EQ(refusal([&] { read("a: 1\ninclude: nowhere.yaml\n"); }),
            place("scene.yaml") + ":2:10: include: no such file: " + place("nowhere.yaml"));
}

TEST_F(Include, AFileThatIncludesItselfIsRefused) {
  write("loop.yaml", "include: loop.yaml\n");
  EXPECT_TRUE(holds(refusal([&] { read("include: loop.yaml\n"); }), "includes itself"));
}

TEST_F(Include, AListIsNoSection) {
  write("list.yaml", "[1, 2]\n");
  EXPECT_TRUE(holds(refusal([&] { read("include: list.yaml\n"); }), "is not a section of keys"));
}

TEST_F(Include, AnErrorOfSyntaxNamesTheIncludedFile) {
  write("bad.yaml", "a: [1\n");
  EXPECT_TRUE(holds(refusal([&] { read("include: bad.yaml\n"); }), place("bad.yaml") + ":1:4: not YAML"));
}

TEST_F(Include, AnAliasedSectionIsRefused) {
  EXPECT_TRUE(holds(refusal([&] { read("a: &x {include: parts/wood.yaml}\nb: *x\n"); }), "through an alias"));
}

TEST_F(Include, TagsAreRefusedWithTheRemedy) {
  EXPECT_TRUE(holds(refusal([&] { read("a: !include parts/wood.yaml\n"); }), "write the key `include: FILE`"));
}

TEST_F(Include, ADumpForAnotherFolderNamesTheSameFiles) {
  const Config c = read("include: parts/wood.yaml\n").resolving();
  c.at("mesh").at("file").file_path();
  const Config there = Config::from_text(c.dump_for(place("elsewhere")), place("elsewhere/scene.yaml"));
  EXPECT_EQ(std::filesystem::weakly_canonical(there.at("mesh").at("file").file_path()),
            std::filesystem::weakly_canonical(place("parts/wood.msh")));
  EXPECT_EQ(c.at("mesh").at("file").text(), "wood.msh");
}

}  // namespace
}  // namespace orthodyn::include_test
