/* vulkan.c - two Vulkan drivers that draw by the processor, without a window: Mesa's lavapipe and
   SwiftShader, which Debian's chromium brings.  glslangValidator makes SPIR-V of the shaders.

   A frame is one command buffer, recorded once.  Images stay in the layout GENERAL, and memory is
   of the first type there is: these drivers have one, which the processor sees. */
#include "peer.h"

#ifdef HAVE_VULKAN
#include <vulkan/vulkan.h>

typedef struct buffer {
    VkBuffer name;
    VkDeviceMemory memory;
    void *bytes;
} buffer;
typedef struct image {
    VkImage name;
    VkDeviceMemory memory;
    VkImageView view;
} image;

static struct device {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;
    VkCommandPool pool;
    /* of a scene; what it does not need is zero, which Vulkan destroys in silence */
    scene s;
    image color, depth, map;
    buffer vertices[2], indices, constants;
    VkRenderPass pass;
    VkFramebuffer frame;
    VkDescriptorSetLayout set_layout;
    VkDescriptorPool sets;
    VkDescriptorSet set;
    VkPipelineLayout layout;
    VkPipeline pipeline;
    VkSampler sampler;
    VkCommandBuffer commands;
} devices[2];

static const char *const device_names[2] = { "llvmpipe", "SwiftShader" };
#define MUST(call) must(call, #call)
static void must(VkResult result, const char *call)
{
    if (result == VK_SUCCESS) return;
    fprintf(stderr, "%.60s: error %d of Vulkan\n", call, (int)result);
    exit(1);
}

/* ---- a folder for glslangValidator ---- */

static char folder[64];
/* The last three answers stay. */
static const char *in_folder(const char *name)
{
    static char path[3][128];
    static int turn;
    turn = (turn + 1) % 3;
    snprintf(path[turn], sizeof path[turn], "%s/%s", folder, name);
    return path[turn];
}

static void write_text(const char *path, const char *text)
{
    FILE *f = fopen(path, "w");
    if (!f || fputs(text, f) < 0 || fclose(f)) {
        fprintf(stderr, "%s: cannot be written\n", path);
        exit(1);
    }
}

static void leave_folder(void)
{
    static const char *const names[] = { "vert", "frag", "spv", "log" };
    for (int k = 0; k < 4; k++) remove(in_folder(names[k]));
    rmdir(folder);
}

static int make_folder(void)
{
    if (folder[0]) return 1;
    strcpy(folder, "/tmp/bench_vulkan_XXXXXX");
    if (!mkdtemp(folder)) return 0;
    atexit(leave_folder);
    return 1;
}

/* ---- devices ---- */

static int find_device(struct device *d, const char *name, char *about, size_t size)
{
    VkPhysicalDevice found[16];
    uint32_t count = 16;
    vkEnumeratePhysicalDevices(d->instance, &count, found);
    for (uint32_t i = 0; i < count; i++) {
        VkPhysicalDeviceProperties p;
        vkGetPhysicalDeviceProperties(found[i], &p);
        if (!strstr(p.deviceName, name)) continue;
        snprintf(about, size, "%s, Vulkan %d.%d", p.deviceName,
                 (int)VK_API_VERSION_MAJOR(p.apiVersion), (int)VK_API_VERSION_MINOR(p.apiVersion));
        d->physical = found[i];
        return 1;
    }
    return 0;
}

static const char *open_device(struct device *d, peer *p)
{
    const float priority = 1;
    const VkInstanceCreateInfo instance = { .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO };
    const VkDeviceQueueCreateInfo queue = { .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                            .queueCount = 1,
                                            .pQueuePriorities = &priority };
    const VkDeviceCreateInfo device = { .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                        .queueCreateInfoCount = 1,
                                        .pQueueCreateInfos = &queue };
    const VkCommandPoolCreateInfo pool = { .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO };
    if (vkCreateInstance(&instance, NULL, &d->instance) != VK_SUCCESS) return "no Vulkan 1.0";
    if (!find_device(d, device_names[p->device], p->about, sizeof p->about)) return "not installed";
    MUST(vkCreateDevice(d->physical, &device, NULL, &d->device));
    vkGetDeviceQueue(d->device, 0, 0, &d->queue);
    MUST(vkCreateCommandPool(d->device, &pool, NULL, &d->pool));
    return NULL;
}

static const char *vulkan_open(peer *p)
{
    setenv("VK_ADD_DRIVER_FILES", "/usr/lib/chromium/vk_swiftshader_icd.json", 0);
    if (system("glslangValidator --version >/dev/null 2>&1")) return "no glslangValidator";
    if (!make_folder()) return "no folder in /tmp";
    return open_device(&devices[p->device], p);
}

/* ---- memory ---- */

static VkDeviceMemory memory_of(struct device *d, VkMemoryRequirements need)
{
    VkMemoryAllocateInfo info = { .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO };
    VkDeviceMemory memory;
    info.allocationSize = need.size;
    while (!(need.memoryTypeBits >> info.memoryTypeIndex & 1)) info.memoryTypeIndex++;
    MUST(vkAllocateMemory(d->device, &info, NULL, &memory));
    return memory;
}

/* bytes: NULL, or what goes in */
static buffer buffer_new(struct device *d, VkBufferUsageFlags usage, const void *bytes, size_t size)
{
    const VkBufferCreateInfo info = { .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                      .size = size,
                                      .usage = usage };
    VkMemoryRequirements need;
    buffer b;
    MUST(vkCreateBuffer(d->device, &info, NULL, &b.name));
    vkGetBufferMemoryRequirements(d->device, b.name, &need);
    b.memory = memory_of(d, need);
    MUST(vkBindBufferMemory(d->device, b.name, b.memory, 0));
    MUST(vkMapMemory(d->device, b.memory, 0, VK_WHOLE_SIZE, 0, &b.bytes));
    if (bytes) memcpy(b.bytes, bytes, size);
    return b;
}

static void buffer_free(struct device *d, buffer b)
{
    vkDestroyBuffer(d->device, b.name, NULL);
    vkFreeMemory(d->device, b.memory, NULL);
}

static const VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
static VkImageSubresourceRange all_levels(VkFormat format)
{
    VkImageSubresourceRange r = { VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, 1 };
    if (format == depth_format) r.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
    return r;
}

static image image_new(struct device *d, VkFormat format, VkImageUsageFlags usage, int width,
                       int height, int levels)
{
    const VkImageCreateInfo info = { .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                     .imageType = VK_IMAGE_TYPE_2D,
                                     .format = format,
                                     .extent = { (uint32_t)width, (uint32_t)height, 1 },
                                     .mipLevels = (uint32_t)levels,
                                     .arrayLayers = 1,
                                     .samples = VK_SAMPLE_COUNT_1_BIT,
                                     .usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT };
    VkImageViewCreateInfo view = { .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                   .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                   .format = format,
                                   .subresourceRange = all_levels(format) };
    VkMemoryRequirements need;
    image i;
    MUST(vkCreateImage(d->device, &info, NULL, &i.name));
    vkGetImageMemoryRequirements(d->device, i.name, &need);
    i.memory = memory_of(d, need);
    MUST(vkBindImageMemory(d->device, i.name, i.memory, 0));
    view.image = i.name;
    MUST(vkCreateImageView(d->device, &view, NULL, &i.view));
    return i;
}

static void image_free(struct device *d, image i)
{
    vkDestroyImageView(d->device, i.view, NULL);
    vkDestroyImage(d->device, i.name, NULL);
    vkFreeMemory(d->device, i.memory, NULL);
}

/* ---- commands ---- */

static VkCommandBuffer commands_begin(struct device *d)
{
    const VkCommandBufferAllocateInfo info = { .sType =
                                                   VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = d->pool,
                                               .commandBufferCount = 1 };
    const VkCommandBufferBeginInfo begin = { .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO };
    VkCommandBuffer c;
    MUST(vkAllocateCommandBuffers(d->device, &info, &c));
    MUST(vkBeginCommandBuffer(c, &begin));
    return c;
}

static void commands_run(struct device *d, VkCommandBuffer c)
{
    const VkSubmitInfo info = { .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                .commandBufferCount = 1,
                                .pCommandBuffers = &c };
    MUST(vkQueueSubmit(d->queue, 1, &info, VK_NULL_HANDLE));
    MUST(vkQueueWaitIdle(d->queue));
}

static void commands_once(struct device *d, VkCommandBuffer c)
{
    MUST(vkEndCommandBuffer(c));
    commands_run(d, c);
    vkFreeCommandBuffers(d->device, d->pool, 1, &c);
}

/* What follows sees what came before; an image that is named enters the layout GENERAL. */
static void order(VkCommandBuffer c, VkImage fresh, VkFormat format)
{
    VkMemoryBarrier all = { .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER };
    VkImageMemoryBarrier one = { .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER };
    all.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    all.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    one.dstAccessMask = all.dstAccessMask;
    one.newLayout = VK_IMAGE_LAYOUT_GENERAL;
    one.srcQueueFamilyIndex = one.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    one.image = fresh;
    one.subresourceRange = all_levels(format);
    vkCmdPipelineBarrier(c, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         0, 1, &all, 0, NULL, fresh != VK_NULL_HANDLE, &one);
}

static VkBufferImageCopy whole_level(VkImageAspectFlags aspect, int level, int width, int height)
{
    VkBufferImageCopy r = { 0 };
    r.imageSubresource.aspectMask = aspect;
    r.imageSubresource.mipLevel = (uint32_t)level;
    r.imageSubresource.layerCount = 1;
    r.imageExtent.width = (uint32_t)width;
    r.imageExtent.height = (uint32_t)height;
    r.imageExtent.depth = 1;
    return r;
}

static void fetch(struct device *d, image from, VkImageAspectFlags aspect, int level, void *out)
{
    size_t size = (size_t)d->s.width * (size_t)d->s.height * 4;
    buffer b = buffer_new(d, VK_BUFFER_USAGE_TRANSFER_DST_BIT, NULL, size);
    VkBufferImageCopy r = whole_level(aspect, level, d->s.width, d->s.height);
    VkCommandBuffer c = commands_begin(d);
    order(c, VK_NULL_HANDLE, depth_format);
    vkCmdCopyImageToBuffer(c, from.name, VK_IMAGE_LAYOUT_GENERAL, b.name, 1, &r);
    order(c, VK_NULL_HANDLE, depth_format);
    commands_once(d, c);
    memcpy(out, b.bytes, size);
    buffer_free(d, b);
}

/* ---- scenes ---- */

static VkFormat color_format(const scene *s)
{
    return s->srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
}

static void load_map(struct device *d, const scene *s, int width, int height, int levels)
{
    buffer b = buffer_new(d, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, s->texels,
                          (size_t)width * (size_t)height * 4);
    VkBufferImageCopy r = whole_level(VK_IMAGE_ASPECT_COLOR_BIT, 0, width, height);
    VkCommandBuffer c = commands_begin(d);
    d->map =
        image_new(d, color_format(s), VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                  width, height, levels);
    order(c, d->map.name, color_format(s));
    vkCmdCopyBufferToImage(c, b.name, d->map.name, VK_IMAGE_LAYOUT_GENERAL, 1, &r);
    commands_once(d, c);
    buffer_free(d, b);
}

static void attachment(VkAttachmentDescription *a, VkFormat format)
{
    a->format = format;
    a->samples = VK_SAMPLE_COUNT_1_BIT;
    a->loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    a->storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    a->stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a->stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a->finalLayout = VK_IMAGE_LAYOUT_GENERAL;
}

/* Depth is the first attachment, colour the second where there is one. */
static void load_target(struct device *d, const scene *s)
{
    VkAttachmentDescription a[2] = { { 0 }, { 0 } };
    VkAttachmentReference depth = { 0, VK_IMAGE_LAYOUT_GENERAL };
    VkAttachmentReference color = { 1, VK_IMAGE_LAYOUT_GENERAL };
    VkSubpassDescription subpass = { 0 };
    VkRenderPassCreateInfo pass = { .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO };
    VkFramebufferCreateInfo frame = { .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO };
    VkImageView views[2] = { d->depth.view, d->color.view };
    attachment(&a[0], depth_format);
    attachment(&a[1], color_format(s));
    subpass.colorAttachmentCount = s->kind != SCENE_DEPTH;
    subpass.pColorAttachments = &color;
    subpass.pDepthStencilAttachment = &depth;
    pass.attachmentCount = 1 + subpass.colorAttachmentCount;
    pass.pAttachments = a;
    pass.subpassCount = 1;
    pass.pSubpasses = &subpass;
    MUST(vkCreateRenderPass(d->device, &pass, NULL, &d->pass));
    frame.renderPass = d->pass;
    frame.attachmentCount = pass.attachmentCount;
    frame.pAttachments = views;
    frame.width = (uint32_t)s->width;
    frame.height = (uint32_t)s->height;
    frame.layers = 1;
    MUST(vkCreateFramebuffer(d->device, &frame, NULL, &d->frame));
}

/* What the shaders read: constants, and the map. */
static void load_set(struct device *d, const scene *s)
{
    static const shade_mat4 clip = {
        { { 1, 0, 0, 0 }, { 0, -1, 0, 0 }, { 0, 0, 0.5f, 0 }, { 0, 0, 0.5f, 1 } }
    }; /* y down, z from 0 to 1 */
    const peer_constants constants = peer_constants_of(s, clip);
    const uint32_t count = s->kind == SCENE_MAP ? 2 : 1; /* lavapipe wants no empty binding */
    VkDescriptorSetLayoutBinding bindings[2] = {
        { 0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_ALL_GRAPHICS, NULL },
        { 1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_ALL_GRAPHICS, NULL }
    };
    VkDescriptorPoolSize sizes[2] = { { VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1 },
                                      { VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1 } };
    VkDescriptorSetLayoutCreateInfo set = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO
    };
    VkDescriptorPoolCreateInfo pool = { .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO };
    VkDescriptorSetAllocateInfo allocate = { .sType =
                                                 VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO };
    VkPipelineLayoutCreateInfo layout = { .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO };
    VkSamplerCreateInfo sampler = { .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO };
    VkWriteDescriptorSet writes[2] = { { .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET },
                                       { .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET } };
    VkDescriptorBufferInfo block = { VK_NULL_HANDLE, 0, VK_WHOLE_SIZE };
    VkDescriptorImageInfo map = { VK_NULL_HANDLE, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_GENERAL };
    d->constants = buffer_new(d, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, &constants, sizeof constants);
    sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR; /* zero: wraps are REPEAT */
    MUST(vkCreateSampler(d->device, &sampler, NULL, &d->sampler));
    set.bindingCount = count;
    set.pBindings = bindings;
    MUST(vkCreateDescriptorSetLayout(d->device, &set, NULL, &d->set_layout));
    pool.maxSets = 1;
    pool.poolSizeCount = count;
    pool.pPoolSizes = sizes;
    MUST(vkCreateDescriptorPool(d->device, &pool, NULL, &d->sets));
    allocate.descriptorPool = d->sets;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &d->set_layout;
    MUST(vkAllocateDescriptorSets(d->device, &allocate, &d->set));
    block.buffer = d->constants.name;
    map.sampler = d->sampler;
    map.imageView = d->map.view;
    for (uint32_t k = 0; k < count; k++) {
        writes[k].dstSet = d->set;
        writes[k].dstBinding = k;
        writes[k].descriptorCount = 1;
        writes[k].descriptorType = bindings[k].descriptorType;
        writes[k].pBufferInfo = &block;
        writes[k].pImageInfo = &map;
    }
    vkUpdateDescriptorSets(d->device, count, writes, 0, NULL);
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &d->set_layout;
    MUST(vkCreatePipelineLayout(d->device, &layout, NULL, &d->layout));
}

/* stage: vert or frag, as glslangValidator calls them and in_folder their files */
static VkShaderModule shader_module(struct device *d, const char *stage, const char *text)
{
    enum { MOST = 1 << 16 };
    static uint32_t words[MOST];
    VkShaderModuleCreateInfo info = { .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO };
    VkShaderModule module;
    char command[512];
    FILE *f;
    write_text(in_folder(stage), text);
    snprintf(command, sizeof command, "glslangValidator -V -S %s -o %s %s >%s", stage,
             in_folder("spv"), in_folder(stage), in_folder("log"));
    f = system(command) ? NULL : fopen(in_folder("spv"), "rb");
    if (!f) {
        fprintf(stderr, "a shader of %s does not compile\n", d->s.name);
        exit(1);
    }
    info.codeSize = 4 * fread(words, 4, MOST, f);
    info.pCode = words;
    fclose(f);
    MUST(vkCreateShaderModule(d->device, &info, NULL, &module));
    return module;
}

static void load_pipeline(struct device *d, const scene *s)
{
    const peer_shaders text = peer_shaders_of(s);
    VkPipelineShaderStageCreateInfo stages[2] = {
        { VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, NULL, 0, VK_SHADER_STAGE_VERTEX_BIT,
          shader_module(d, "vert", text.vertex), "main", NULL },
        { VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, NULL, 0,
          VK_SHADER_STAGE_FRAGMENT_BIT, shader_module(d, "frag", text.fragment), "main", NULL }
    };
    const VkVertexInputBindingDescription arrays[2] = { { 0, 12, VK_VERTEX_INPUT_RATE_VERTEX },
                                                        { 1, 12, VK_VERTEX_INPUT_RATE_VERTEX } };
    const VkVertexInputAttributeDescription attributes[2] = {
        { 0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0 }, { 1, 1, VK_FORMAT_R32G32B32_SFLOAT, 0 }
    };
    const VkViewport whole = { 0, 0, (float)s->width, (float)s->height, 0, 1 };
    const VkRect2D scissor = { { 0, 0 }, { (uint32_t)s->width, (uint32_t)s->height } };
    VkPipelineVertexInputStateCreateInfo input = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO
    };
    VkPipelineInputAssemblyStateCreateInfo assembly = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO
    };
    VkPipelineViewportStateCreateInfo viewport = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO
    };
    VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO
    };
    VkPipelineMultisampleStateCreateInfo samples = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO
    };
    VkPipelineDepthStencilStateCreateInfo depth = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO
    };
    VkPipelineColorBlendAttachmentState all = { 0 };
    VkPipelineColorBlendStateCreateInfo blend = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO
    };
    VkGraphicsPipelineCreateInfo info = { .sType =
                                              VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO };
    input.vertexBindingDescriptionCount = input.vertexAttributeDescriptionCount =
        s->kind == SCENE_LIT || s->kind == SCENE_MAP ? 2 : 1;
    input.pVertexBindingDescriptions = arrays;
    input.pVertexAttributeDescriptions = attributes;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    viewport.viewportCount = viewport.scissorCount = 1;
    viewport.pViewports = &whole;
    viewport.pScissors = &scissor;
    raster.cullMode = s->state.raster.cull == SHADE_CULL_BACK ? VK_CULL_MODE_BACK_BIT : 0;
    raster.lineWidth = 1; /* zero: counter-clockwise triangles show their faces */
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_LESS;
    all.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                         VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    blend.attachmentCount = s->kind != SCENE_DEPTH;
    blend.pAttachments = &all;
    info.stageCount = 2;
    info.pStages = stages;
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.layout = d->layout;
    info.renderPass = d->pass;
    MUST(vkCreateGraphicsPipelines(d->device, VK_NULL_HANDLE, 1, &info, NULL, &d->pipeline));
    for (int k = 0; k < 2; k++) vkDestroyShaderModule(d->device, stages[k].module, NULL);
}

static void load_mesh(struct device *d, const scene *s)
{
    size_t bytes = (size_t)s->vertex_count * 12;
    d->vertices[0] = buffer_new(d, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, s->positions, bytes);
    d->vertices[1] = buffer_new(d, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, s->normals, bytes);
    d->indices =
        buffer_new(d, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, s->indices, (size_t)s->index_count * 4);
    if (s->kind == SCENE_MAP) load_map(d, s, SCENE_TEXELS, SCENE_TEXELS, 1);
    load_set(d, s);
    load_pipeline(d, s);
}

static void record_pass(struct device *d, const scene *s, VkCommandBuffer c)
{
    VkRenderPassBeginInfo begin = { .sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO };
    const VkClearValue clear[2] = {
        { .depthStencil = { 1, 0 } },
        { .color = { { s->background.x, s->background.y, s->background.z, s->background.w } } }
    };
    const VkBuffer arrays[2] = { d->vertices[0].name, d->vertices[1].name };
    const VkDeviceSize offsets[2] = { 0, 0 };
    begin.renderPass = d->pass;
    begin.framebuffer = d->frame;
    begin.renderArea.extent.width = (uint32_t)s->width;
    begin.renderArea.extent.height = (uint32_t)s->height;
    begin.clearValueCount = 2;
    begin.pClearValues = clear;
    vkCmdBeginRenderPass(c, &begin, VK_SUBPASS_CONTENTS_INLINE);
    if (s->kind < SCENE_CLEAR) {
        vkCmdBindPipeline(c, VK_PIPELINE_BIND_POINT_GRAPHICS, d->pipeline);
        vkCmdBindDescriptorSets(c, VK_PIPELINE_BIND_POINT_GRAPHICS, d->layout, 0, 1, &d->set, 0,
                                NULL);
        vkCmdBindVertexBuffers(c, 0, 2, arrays, offsets);
        vkCmdBindIndexBuffer(c, d->indices.name, 0, VK_INDEX_TYPE_UINT32);
        vkCmdDrawIndexed(c, (uint32_t)s->index_count, 1, 0, 0, 0);
    }
    vkCmdEndRenderPass(c);
}

/* From a level of width x height to the first level of another image, or to the next of this. */
static void record_halve(VkCommandBuffer c, VkImage from, VkImage to, int level, int width,
                         int height)
{
    VkImageBlit r = { 0 };
    r.srcSubresource = whole_level(VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 0).imageSubresource;
    r.dstSubresource = r.srcSubresource;
    if (from == to) r.dstSubresource.mipLevel++;
    r.srcOffsets[1] = (VkOffset3D){ width, height, 1 };
    r.dstOffsets[1] = (VkOffset3D){ width / 2, height / 2, 1 };
    vkCmdBlitImage(c, from, VK_IMAGE_LAYOUT_GENERAL, to, VK_IMAGE_LAYOUT_GENERAL, 1, &r,
                   VK_FILTER_LINEAR);
}

static void vulkan_load(const peer *p, const scene *s)
{
    struct device *d = &devices[p->device];
    const VkImageUsageFlags copied = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    int levels = 1;
    d->s = *s;
    if (s->kind == SCENE_MIPMAPS)
        while (2 * s->width >> levels) levels++;
    if (s->kind >= SCENE_MIPMAPS) load_map(d, s, 2 * s->width, 2 * s->height, levels);
    d->color = image_new(d, color_format(s), VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | copied, s->width,
                         s->height, 1);
    d->depth = image_new(d, depth_format, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, s->width,
                         s->height, 1);
    if (s->kind < SCENE_MIPMAPS) load_target(d, s);
    if (s->kind < SCENE_CLEAR) load_mesh(d, s);
    d->commands = commands_begin(d);
    if (s->kind < SCENE_MIPMAPS) record_pass(d, s, d->commands);
    if (s->kind == SCENE_RESOLVE) {
        order(d->commands, d->color.name, color_format(s));
        record_halve(d->commands, d->map.name, d->color.name, 0, 2 * s->width, 2 * s->height);
    }
    for (int i = 0; i + 1 < levels; i++) {
        order(d->commands, VK_NULL_HANDLE, depth_format);
        record_halve(d->commands, d->map.name, d->map.name, i, 2 * s->width >> i,
                     2 * s->height >> i);
    }
    MUST(vkEndCommandBuffer(d->commands));
}

static void vulkan_draw(const peer *p)
{
    struct device *d = &devices[p->device];
    commands_run(d, d->commands);
}

static void vulkan_read(const peer *p, uint32_t *rgba, float *depth)
{
    struct device *d = &devices[p->device];
    const VkImageAspectFlags color = VK_IMAGE_ASPECT_COLOR_BIT;
    if (d->s.kind == SCENE_MIPMAPS)
        fetch(d, d->map, color, 1, rgba);
    else if (d->s.kind != SCENE_DEPTH)
        fetch(d, d->color, color, 0, rgba);
    if (d->s.kind < SCENE_MIPMAPS) fetch(d, d->depth, VK_IMAGE_ASPECT_DEPTH_BIT, 0, depth);
}

static void vulkan_unload(const peer *p)
{
    struct device *d = &devices[p->device], kept = { 0 };
    vkFreeCommandBuffers(d->device, d->pool, 1, &d->commands);
    vkDestroyPipeline(d->device, d->pipeline, NULL);
    vkDestroyPipelineLayout(d->device, d->layout, NULL);
    vkDestroyDescriptorPool(d->device, d->sets, NULL);
    vkDestroyDescriptorSetLayout(d->device, d->set_layout, NULL);
    vkDestroySampler(d->device, d->sampler, NULL);
    vkDestroyFramebuffer(d->device, d->frame, NULL);
    vkDestroyRenderPass(d->device, d->pass, NULL);
    buffer_free(d, d->vertices[0]);
    buffer_free(d, d->vertices[1]);
    buffer_free(d, d->indices);
    buffer_free(d, d->constants);
    image_free(d, d->color);
    image_free(d, d->depth);
    image_free(d, d->map);
    kept.instance = d->instance;
    kept.physical = d->physical;
    kept.device = d->device;
    kept.queue = d->queue;
    kept.pool = d->pool;
    *d = kept;
}
#define VULKAN(f) vulkan_##f
#else
#define VULKAN(f) NULL
#endif

peer *vulkan_peer(int device)
{
    static peer p[2] = { { "lavapipe", VULKAN_LAVAPIPE, "", VULKAN(open), VULKAN(load),
                           VULKAN(draw), VULKAN(read), VULKAN(unload) },
                         { "SwiftShader", VULKAN_SWIFTSHADER, "", VULKAN(open), VULKAN(load),
                           VULKAN(draw), VULKAN(read), VULKAN(unload) } };
    return &p[device];
}
