// Atomic writing of files: a file is written completely or not at all. Failures throw RunError with the system's error
// message, except in write_all() and remove_partial_files().
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace orthodyn {

// Whether this process writes files. Only the first of several MPI ranks does; on the others, after
// disable_file_writing(), functions that would change a file do nothing.
bool writes_files();
void disable_file_writing();

// Writes the parts one after the other into NAME.<process>-<number>.part, then renames that file to NAME. Creates the
// folder. Devices and pipes are written directly.
void write_file(const std::filesystem::path& path, const std::vector<std::string>& parts);

// As write_file(). Once this function has returned, the file survives a power failure.
void write_durable_file(const std::filesystem::path& path, const std::vector<std::string>& parts);

// Writes all of `text` into an open file, `at` bytes after its start. Returns false on failure, with the cause in
// errno.
bool write_all(int file, std::string_view text, std::size_t at);

// Removes the files NAME.<process>-<number>.part that killed processes left in a folder and its subfolders.
// Precondition: no other process writes there.
void remove_partial_files(const std::filesystem::path& folder);

// Waits until the content of a file is on the disk.
void sync_to_disk(const std::filesystem::path& path);

// Creates the folder of a file, with its parents.
void make_folder_of(const std::filesystem::path& path);

// Throws the RunError of a failed write, with the cause in errno.
[[noreturn]] void fail_to_write(const std::filesystem::path& path);

}  // namespace orthodyn
