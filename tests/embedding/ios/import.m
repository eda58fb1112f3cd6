// import.m - the header as a module, as Objective-C and Swift take it.
@import bsm;

bsm_status open_default(bsm_config* config, void* arena, size_t bytes, bsm_context** context) {
  const bsm_status status = bsm_config_init(config, 640, 480);
  return status == BSM_OK ? bsm_open(config, arena, bytes, context) : status;
}
