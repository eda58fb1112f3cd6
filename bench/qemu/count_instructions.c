/* count_instructions.c - a plugin of qemu's user emulators: counts the instructions that a program runs. At exit it writes
   to the file of the option out=FILE one line for each block of straight code: how often it ran, its instructions, its
   address in hexadecimal, its function or "-". It counts a single thread; several would race. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* What is used of qemu's plugin interface, version 1. */
typedef uint64_t qemu_plugin_id_t;
typedef struct qemu_info_t qemu_info_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };
typedef void translated_fn(qemu_plugin_id_t id, struct qemu_plugin_tb* block);
typedef void ended_fn(qemu_plugin_id_t id, void* data);
extern size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb* block);
extern uint64_t qemu_plugin_tb_vaddr(const struct qemu_plugin_tb* block);
extern struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb* block, size_t index);
extern const char* qemu_plugin_insn_symbol(const struct qemu_plugin_insn* insn);
extern void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id, translated_fn* translated);
extern void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb* block, enum qemu_plugin_op op, void* counter,
                                                     uint64_t added);
extern void qemu_plugin_register_atexit_cb(qemu_plugin_id_t id, ended_fn* ended, void* data);

#define EXPORT __attribute__((visibility("default")))
extern EXPORT int qemu_plugin_version;
extern EXPORT int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t* info, int argc, char** argv);
int qemu_plugin_version = 1;

/* A block that is translated again has several entries. */
enum { MAX_BLOCKS = 1 << 18 };
static struct {
  uint64_t runs, address, instructions;
  const char* function; /* the emulator's own, for as long as it runs */
} blocks[MAX_BLOCKS];
static size_t blocks_count;
static char path[4096];

static void block_translated(qemu_plugin_id_t id, struct qemu_plugin_tb* block) {
  (void)id;
  if (blocks_count == MAX_BLOCKS) return; /* run_ended says so */
  const char* const function = qemu_plugin_insn_symbol(qemu_plugin_tb_get_insn(block, 0));
  blocks[blocks_count].address = qemu_plugin_tb_vaddr(block);
  blocks[blocks_count].instructions = qemu_plugin_tb_n_insns(block);
  blocks[blocks_count].function = function != NULL && function[0] != '\0' ? function : "-";
  qemu_plugin_register_vcpu_tb_exec_inline(block, QEMU_PLUGIN_INLINE_ADD_U64, &blocks[blocks_count].runs, 1);
  ++blocks_count;
}

static void run_ended(qemu_plugin_id_t id, void* data) {
  (void)id;
  (void)data;
  FILE* const file = blocks_count < MAX_BLOCKS ? fopen(path, "w") : NULL;
  if (file == NULL) {
    fprintf(stderr, "count_instructions: too many blocks, or %s cannot be written\n", path);
    return;
  }
  for (size_t i = 0; i < blocks_count; ++i) {
    fprintf(file, "%llu %llu %llx %s\n", (unsigned long long)blocks[i].runs, (unsigned long long)blocks[i].instructions,
            (unsigned long long)blocks[i].address, blocks[i].function);
  }
  fclose(file);
}

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t* info, int argc, char** argv) {
  (void)info;
  if (argc != 1 || strncmp(argv[0], "out=", 4) != 0 || strlen(argv[0] + 4) >= sizeof path) {
    fprintf(stderr, "count_instructions: the option out=FILE is missing\n");
    return 1;
  }
  strcpy(path, argv[0] + 4);
  qemu_plugin_register_vcpu_tb_trans_cb(id, block_translated);
  qemu_plugin_register_atexit_cb(id, run_ended, NULL);
  return 0;
}
