// Sections and symbols are read by libelf, instructions by Zydis.
#include "host/ocl/machine_code.h"

#include <Zydis/Zydis.h>
#include <gelf.h>
#include <libelf.h>

#include <algorithm>
#include <memory>
#include <string_view>

namespace glintmark {
namespace {

using ElfFile = std::unique_ptr<Elf, decltype([](Elf* elf) { elf_end(elf); })>;

// Calls visit(header, section) for every section until one call returns true.
template <typename Visit>
void visitSections(Elf* elf, const Visit& visit) {
  for (Elf_Scn* section = nullptr; (section = elf_nextscn(elf, section)) != nullptr;) {
    GElf_Shdr header;
    if (gelf_getshdr(section, &header) != nullptr && visit(header, section)) return;
  }
}

// The defined function of that name in either symbol table.
std::optional<GElf_Sym> findSymbol(Elf* elf, std::string_view function) {
  std::optional<GElf_Sym> found;
  visitSections(elf, [&](const GElf_Shdr& header, Elf_Scn* section) {
    if (header.sh_type != SHT_SYMTAB && header.sh_type != SHT_DYNSYM) return false;
    Elf_Data* table = elf_getdata(section, nullptr);
    if (table == nullptr || header.sh_entsize == 0) return false;
    const int count = static_cast<int>(header.sh_size / header.sh_entsize);
    GElf_Sym symbol;
    for (int i = 0; i < count && gelf_getsym(table, i, &symbol) != nullptr; ++i) {
      const char* name = elf_strptr(elf, header.sh_link, symbol.st_name);
      const bool defined = GELF_ST_TYPE(symbol.st_info) == STT_FUNC && symbol.st_shndx != SHN_UNDEF;
      if (!defined || name == nullptr || function != name) continue;
      found = symbol;
      return true;
    }
    return false;
  });
  return found;
}

struct DecodedInstruction {
  ZydisDecodedInstruction instruction;
  ZydisDecodedOperand operands[ZYDIS_MAX_OPERAND_COUNT];

  std::span<const ZydisDecodedOperand> written() const {
    return {operands, instruction.operand_count_visible};
  }
};

bool isVector512(ZydisRegister reg) {
  return ZydisRegisterGetClass(reg) == ZYDIS_REGCLASS_ZMM;
}

bool names512(const ZydisDecodedOperand& operand) {
  if (operand.type == ZYDIS_OPERAND_TYPE_REGISTER) return isVector512(operand.reg.value);
  return operand.type == ZYDIS_OPERAND_TYPE_MEMORY && isVector512(operand.mem.index);
}

// What compilers fill gaps with; two-byte ones exchange ax with itself.
bool isPadding(const DecodedInstruction& decoded) {
  const ZydisMnemonic mnemonic = decoded.instruction.mnemonic;
  const auto is_ax = [](const ZydisDecodedOperand& operand) {
    return operand.type == ZYDIS_OPERAND_TYPE_REGISTER && operand.reg.value == ZYDIS_REGISTER_AX;
  };
  return mnemonic == ZYDIS_MNEMONIC_NOP || mnemonic == ZYDIS_MNEMONIC_INT3 ||
         (mnemonic == ZYDIS_MNEMONIC_XCHG && std::ranges::all_of(decoded.written(), is_ax));
}

Instruction instructionOf(const DecodedInstruction& decoded, std::uint64_t address) {
  const ZydisMnemonic mnemonic = decoded.instruction.mnemonic;
  const ZydisInstructionCategory category = decoded.instruction.meta.category;
  Instruction instruction;
  instruction.address = address;
  instruction.vector_512 = std::ranges::any_of(decoded.written(), names512);
  instruction.multiply = mnemonic == ZYDIS_MNEMONIC_VPMULLD || mnemonic == ZYDIS_MNEMONIC_IMUL;
  instruction.call = category == ZYDIS_CATEGORY_CALL;
  instruction.falls_through =
      category != ZYDIS_CATEGORY_UNCOND_BR && category != ZYDIS_CATEGORY_RET;
  ZyanU64 target = 0;
  const bool jump = category == ZYDIS_CATEGORY_COND_BR || category == ZYDIS_CATEGORY_UNCOND_BR;
  if (jump && decoded.operands[0].type == ZYDIS_OPERAND_TYPE_IMMEDIATE &&
      ZYAN_SUCCESS(
          ZydisCalcAbsoluteAddress(&decoded.instruction, decoded.operands, address, &target)))
    instruction.jump_target = target;
  return instruction;
}

}  // namespace

std::optional<FunctionCode> findFunction(std::span<const char> elf_file, const char* function) {
  elf_version(EV_CURRENT);
  // libelf writes into the image only on elf_update, which is not called.
  const ElfFile elf(elf_memory(const_cast<char*>(elf_file.data()), elf_file.size()));
  GElf_Ehdr header;
  if (!elf || gelf_getehdr(elf.get(), &header) == nullptr || header.e_machine != EM_X86_64)
    return std::nullopt;
  const std::optional<GElf_Sym> symbol = findSymbol(elf.get(), function);
  if (!symbol) return std::nullopt;

  std::optional<FunctionCode> code;
  visitSections(elf.get(), [&](const GElf_Shdr& section, Elf_Scn* handle) {
    if (elf_ndxscn(handle) != symbol->st_shndx) return false;
    const Elf_Data* data = elf_getdata(handle, nullptr);
    const std::uint64_t offset = symbol->st_value - section.sh_addr;
    if (data == nullptr || data->d_buf == nullptr || offset > data->d_size ||
        symbol->st_size > data->d_size - offset)
      return true;
    const auto* first = static_cast<const std::uint8_t*>(data->d_buf) + offset;
    code = FunctionCode{symbol->st_value, {first, first + symbol->st_size}};
    return true;
  });
  return code;
}

std::optional<std::vector<Instruction>> disassemble(const FunctionCode& code) {
  ZydisDecoder decoder;
  ZydisDecoderInit(&decoder, ZYDIS_MACHINE_MODE_LONG_64, ZYDIS_STACK_WIDTH_64);
  std::vector<Instruction> instructions;
  DecodedInstruction decoded;
  for (std::size_t at = 0; at < code.bytes.size(); at += decoded.instruction.length) {
    if (!ZYAN_SUCCESS(ZydisDecoderDecodeFull(&decoder, code.bytes.data() + at,
                                             code.bytes.size() - at, &decoded.instruction,
                                             decoded.operands)))
      return std::nullopt;
    if (!isPadding(decoded)) instructions.push_back(instructionOf(decoded, code.address + at));
  }
  return instructions;
}

}  // namespace glintmark
