#include "api/check.h"
#include "api/desc.h"
#include "api/handles.h"

namespace bdpt {
namespace {

constexpr uint32_t kMaxThreads = 4096;

// The host's executor and log as they came in. Their drops are owed from the moment they can be read, so also when the
// structs are then refused. A struct of another ABI or of a size that is none cannot be read, and nothing of it is
// called.
struct HostObjects {
  explicit HostObjects(const bdpt_context_desc* desc)
      : HostObjects(is_readable(desc) ? copy_readable(*desc) : bdpt_context_desc{}) {}

  bdpt_executor executor;
  bdpt_log log;
  FinalCall drop_executor, drop_log;

 private:
  explicit HostObjects(const bdpt_context_desc& desc)
      : executor(is_readable(desc.executor) ? copy_readable(*desc.executor) : bdpt_executor{}),
        log(is_readable(desc.log) ? copy_readable(*desc.log) : bdpt_log{}),
        drop_executor(executor.drop, executor.user),
        drop_log(log.drop, log.user) {}
};

void check_executor(const bdpt_context_desc& desc) {
  const bdpt_executor executor = read_struct(desc.executor, "desc.executor");
  require(executor.run, "desc.executor.run");
  if (executor.worker_count < 1 || executor.worker_count > kMaxThreads)
    fail(ErrorCode::InvalidArgument, "desc.executor.worker_count is ", executor.worker_count, ": give 1 to ",
         kMaxThreads);
  if (desc.threads != 0)
    fail(ErrorCode::InvalidArgument, "desc.threads is ", desc.threads,
         " although desc.executor brings the threads: set one of the two");
}

void check_log(const bdpt_log* caller) {
  const bdpt_log log = read_struct(caller, "desc.log");
  require(log.write, "desc.log.write");
  if (log.reserved != 0) fail(ErrorCode::InvalidArgument, "desc.log.reserved is ", log.reserved, ": it must be 0");
}

bdpt_context_desc check_context_desc(const bdpt_context_desc* caller) {
  const bdpt_context_desc desc = read_optional_struct(caller, "desc");
  if (desc.threads > kMaxThreads)
    fail(ErrorCode::InvalidArgument, "desc.threads is ", desc.threads, ": give at most ", kMaxThreads,
         ", or 0 for all cores");
  if (desc.isa < BDPT_ISA_BEST || desc.isa > BDPT_ISA_NEON)
    fail(ErrorCode::InvalidArgument, "desc.isa is ", desc.isa, ": give one of the constants BDPT_ISA_*");
  if (desc.reserved != 0) fail(ErrorCode::InvalidArgument, "desc.reserved is ", desc.reserved, ": it must be 0");
  if (desc.executor) check_executor(desc);
  if (desc.log) check_log(desc.log);
  return desc;
}

std::shared_ptr<Executor> make_executor(const bdpt_context_desc& desc, HostObjects& host) {
  if (!desc.executor) return make_pool(desc.threads);
  // The drop goes with the function object: however the executor ends, it is called once.
  HostExecutor executor{host.executor.worker_count, host.executor.run, host.executor.user, {}};
  executor.drop = [drop = std::make_shared<FinalCall>(std::move(host.drop_executor))] {};
  return make_host_executor(std::move(executor));
}

}  // namespace
}  // namespace bdpt

using namespace bdpt;

bdpt_result bdpt_context_create(uint32_t abi, const bdpt_context_desc* desc, bdpt_context** context) {
  return guard(__func__, [&] {
    reset_output(context);
    if (abi != BDPT_ABI)
      fail(ErrorCode::Abi, "the program was built for ABI ", abi, ", this library is of ABI ", BDPT_ABI,
           ": use a bdpt.h and a library of one version");
    HostObjects host(desc);
    const bdpt_context_desc d = check_context_desc(desc);
    if (const char* name = refused_code_isa())
      fail(ErrorCode::Unsupported, "the environment variable BDPT_ISA is \"", name,
           "\", which this machine or this library does not have: give baseline, avx2 or avx512, or unset it");
    require(context, "context");
    auto object = std::make_unique<bdpt_context>();
    object->meter = std::make_shared<MemoryMeter>(d.memory_limit);
    object->log =
        d.log ? std::make_unique<const Log>(host.log, std::move(host.drop_log)) : std::make_unique<const Log>();
    object->device = std::make_shared<const RayDevice>(static_cast<Isa>(d.isa), object->meter);
    object->executor = make_executor(d, host);
    object->colors =
        std::make_unique<const ColorSpaces>(text_or_empty(d.color_config), text_or_empty(d.rendering_space));
    *context = object.release();
  });
}

void bdpt_context_retain(bdpt_context* context) {
  if (context) context->retain();
}

void bdpt_context_release(bdpt_context* context) {
  if (context) context->release();
}

bdpt_result bdpt_context_get_info(const bdpt_context* context, bdpt_context_info* info) {
  return guard(__func__, [&] {
    require(context, "context");
    check_output_struct(info, "info");
    bdpt_context_info result{};
    result.threads = context->executor->worker_count();
    result.isa = static_cast<bdpt_isa>(context->device->isa());
    result.code_isa = static_cast<bdpt_isa>(code_isa());
    result.embree = context->device->running_version();
    result.memory = context->meter->used();
    result.memory_peak = context->meter->peak();
    write_struct(result, info);
  });
}
