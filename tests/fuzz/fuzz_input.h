// The importer opens files, a fuzzer hands over bytes: one file in a folder of this process, in memory where
// the system has such a place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace kilolux::fuzz {

class InputFile {
  public:
    explicit InputFile(const std::string& name) {
        const bool hasMemory = access("/dev/shm", W_OK) == 0;
        std::string pattern = (hasMemory ? "/dev/shm" : std::filesystem::temp_directory_path().string());
        pattern += "/kilolux-fuzz-XXXXXX";
        folder_ = mkdtemp(pattern.data());
        path_ = folder_ / name;
    }
    ~InputFile() { std::filesystem::remove_all(folder_); }

    const std::filesystem::path& path() const { return path_; }
    void write(const std::uint8_t* data, std::size_t size) const {
        std::ofstream(path_, std::ios::binary | std::ios::trunc)
            .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    }

  private:
    std::filesystem::path folder_, path_;
};

} // namespace kilolux::fuzz
