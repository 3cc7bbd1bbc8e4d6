// Files that are whole or absent. All throw RunError with the reason of the system.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace orthodyn {

// Whether this process writes its results. Of several ranks one does, and the others leave all files to it: whatever
// would change a file then does nothing.
bool writes_files();
void leave_files_to_others();

// Writes the parts one after the other. To a new file NAME.<process>-<number>.part first, then renamed: the file is
// whole or absent. Its folder is made. Devices and pipes are written to as they are.
void write_file(const std::filesystem::path& path, const std::vector<std::string>& parts);

// The same; it survives a power cut once this has returned.
void write_lasting_file(const std::filesystem::path& path, const std::vector<std::string>& parts);

// Writes all of a text into an open file, `at` bytes from its begin, as many calls to the system as it takes. False
// with the reason in errno.
bool write_all(int file, std::string_view text, std::size_t at);

// Removes the NAME.<process>-<number>.part of processes that were killed while they wrote, from a folder and those
// within. Precondition: no other process writes there.
void remove_partial_files(const std::filesystem::path& folder);

// Waits until what was written to a file is on the disk.
void make_lasting(const std::filesystem::path& path);

// The folder that a file is to stand in, with those above it.
void make_folder_of(const std::filesystem::path& path);

// What they throw, with the reason in errno.
[[noreturn]] void fail_to_write(const std::filesystem::path& path);

}  // namespace orthodyn
