#include "bench/code_map.hpp"

#include <llvm/DebugInfo/DWARF/DWARFContext.h>
#include <llvm/Object/ELFObjectFile.h>
#include <llvm/Object/ObjectFile.h>
#include <llvm/Support/MemoryBuffer.h>

#include <algorithm>
#include <map>
#include <unordered_map>

#include "jit/detail/gdb_interface.h"

// This is last, since its macros are names of LLVM's.
#include <link.h>

namespace navjit::bench {
namespace {

std::string without_arguments(const std::string& name) { return name.substr(0, name.find('<')); }

struct Range {
  std::uint64_t begin, end;
};

struct Generated {
  std::unique_ptr<llvm::object::ObjectFile> object;
  std::unique_ptr<llvm::DWARFContext> debug;
  std::vector<Range> code;
};

Generated read_generated(const jit_code_entry& entry) {
  Generated g;
  auto object = llvm::object::ObjectFile::createObjectFile(
      {llvm::StringRef(entry.symfile_addr, entry.symfile_size), "generated"});
  if (!object) {
    llvm::consumeError(object.takeError());
    return g;
  }
  g.object = std::move(*object);
  for (const llvm::object::SectionRef& section : g.object->sections()) {
    if (section.isText() && section.getSize() != 0 && section.getAddress() != 0) {
      g.code.push_back({section.getAddress(), section.getAddress() + section.getSize()});
    }
  }
  g.debug = llvm::DWARFContext::create(*g.object);
  return g;
}

}  // namespace

struct CodeMap::Impl {
  std::vector<Generated> generated;
  std::map<std::uint64_t, std::pair<std::uint64_t, std::string>> own;  ///< by begin: end and name
  std::unordered_map<std::uint64_t, Place> known;

  void read_own_symbols() {
    std::uint64_t base = 0;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* to) {
          *static_cast<std::uint64_t*>(to) = info->dlpi_addr;
          return 1;  // the program itself comes first
        },
        &base);
    auto file = llvm::object::ObjectFile::createObjectFile("/proc/self/exe");
    if (!file) {
      llvm::consumeError(file.takeError());
      return;
    }
    for (const llvm::object::SymbolRef& symbol : file->getBinary()->symbols()) {
      auto name = symbol.getName();
      auto address = symbol.getAddress();
      if (!name || !address) {
        llvm::consumeError(name.takeError());
        llvm::consumeError(address.takeError());
        continue;
      }
      const std::uint64_t size = llvm::object::ELFSymbolRef(symbol).getSize();
      if (size != 0) own[base + *address] = {base + *address + size, name->str()};
    }
  }

  Place find(std::uint64_t address) {
    for (Generated& g : generated) {
      for (const Range& range : g.code) {
        if (address < range.begin || address >= range.end) continue;
        Place place{true, {}};
        const llvm::DIInliningInfo chain = g.debug->getInliningInfoForAddress(
            {address, llvm::object::SectionedAddress::UndefSection},
            {llvm::DILineInfoSpecifier::FileLineInfoKind::None,
             llvm::DILineInfoSpecifier::FunctionNameKind::ShortName});
        for (std::uint32_t i = chain.getNumberOfFrames(); i-- > 0;) {
          place.functions.push_back(without_arguments(chain.getFrame(i).FunctionName));
        }
        return place;
      }
    }
    Place place;
    const auto after = own.upper_bound(address);
    if (after != own.begin()) {
      const auto& [end, name] = std::prev(after)->second;
      if (address < end) place.functions.push_back(name);
    }
    return place;
  }
};

CodeMap::CodeMap() : impl_(std::make_unique<Impl>()) {
  for (const jit_code_entry* e = __jit_debug_descriptor.first_entry; e != nullptr;
       e = e->next_entry) {
    impl_->generated.push_back(read_generated(*e));
  }
  impl_->read_own_symbols();
}

CodeMap::~CodeMap() = default;

const CodeMap::Place& CodeMap::at(std::uint64_t address) {
  const auto [at, fresh] = impl_->known.try_emplace(address);
  if (fresh) at->second = impl_->find(address);
  return at->second;
}

}  // namespace navjit::bench
