#include "jit/detail/debugger.hpp"

#include <elf.h>

#include <cstring>
#include <mutex>

#include "jit/detail/gdb_interface.h"

namespace navjit::jit::detail {
namespace {

enum Action : std::uint32_t { no_action = 0, register_action = 1, unregister_action = 2 };

std::mutex& descriptor_mutex() {
  // There is one descriptor in the process, whatever the number of linkers.
  static std::mutex mutex;
  return mutex;
}

void notify(jit_code_entry* entry, Action action) {
  __jit_debug_descriptor.relevant_entry = entry;
  __jit_debug_descriptor.action_flag = action;
  __jit_debug_register_code();  // the debugger has a breakpoint here
  __jit_debug_descriptor.relevant_entry = nullptr;
  __jit_debug_descriptor.action_flag = no_action;
}

/// Writes the addresses into the section headers, where the debugger looks for them.
void place_sections(std::vector<char>& object,
                    const std::map<std::string, std::uint64_t>& section_addresses) {
  Elf64_Ehdr header;
  if (object.size() < sizeof header) return;
  std::memcpy(&header, object.data(), sizeof header);
  const std::uint64_t size = object.size();
  const auto read_section = [&](std::uint64_t index, Elf64_Shdr& section) {
    const std::uint64_t offset = header.e_shoff + index * sizeof section;
    if (header.e_shoff > size || offset > size || size - offset < sizeof section) return false;
    std::memcpy(&section, object.data() + offset, sizeof section);
    return true;
  };
  Elf64_Shdr names;
  if (!read_section(header.e_shstrndx, names) || names.sh_offset > size ||
      names.sh_size > size - names.sh_offset) {
    return;
  }
  const std::string name_table(object.data() + names.sh_offset, names.sh_size);
  for (std::uint64_t i = 0; i < header.e_shnum; ++i) {
    Elf64_Shdr section;
    if (!read_section(i, section) || section.sh_name >= name_table.size()) continue;
    const auto address = section_addresses.find(name_table.c_str() + section.sh_name);
    if ((section.sh_flags & SHF_ALLOC) == 0 || address == section_addresses.end()) continue;
    section.sh_addr = address->second;
    std::memcpy(object.data() + header.e_shoff + i * sizeof section, &section, sizeof section);
  }
}

}  // namespace

struct DebuggerRegistration::Entry : jit_code_entry {};

DebuggerRegistration::DebuggerRegistration(
    std::vector<char> object, const std::map<std::string, std::uint64_t>& section_addresses)
    : object_(std::move(object)), entry_(std::make_unique<Entry>()) {
  place_sections(object_, section_addresses);
  entry_->symfile_addr = object_.data();
  entry_->symfile_size = object_.size();
  const std::lock_guard lock(descriptor_mutex());
  entry_->prev_entry = nullptr;
  entry_->next_entry = __jit_debug_descriptor.first_entry;
  if (entry_->next_entry != nullptr) entry_->next_entry->prev_entry = entry_.get();
  __jit_debug_descriptor.first_entry = entry_.get();
  notify(entry_.get(), register_action);
}

DebuggerRegistration::~DebuggerRegistration() {
  const std::lock_guard lock(descriptor_mutex());
  (entry_->prev_entry != nullptr ? entry_->prev_entry->next_entry
                                 : __jit_debug_descriptor.first_entry) = entry_->next_entry;
  if (entry_->next_entry != nullptr) entry_->next_entry->prev_entry = entry_->prev_entry;
  notify(entry_.get(), unregister_action);
}

}  // namespace navjit::jit::detail
