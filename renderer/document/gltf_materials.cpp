// Materials and texture references (glTF 2.0, sections 3.8 and 3.9; KHR_texture_transform,
// KHR_materials_emissive_strength, _transmission, _unlit and _pbrSpecularGlossiness).
#include "renderer/document/gltf_images.h"
#include "renderer/document/gltf_model.h"

#include <algorithm>
#include <cmath>

namespace kilolux::gltf {

namespace {

using Extensions = tinygltf::ExtensionMap;

const tinygltf::Value* findExtension(const Extensions& extensions, const char* name) {
    const auto it = extensions.find(name);
    return it == extensions.end() || !it->second.IsObject() ? nullptr : &it->second;
}

// A number of an extension's object, or the default (with a warning where it is of another type or out of
// range).
double numberOr(ImportContext& context, const tinygltf::Value& object, const std::string& key,
                double fallback, double min, double max, const std::string& place) {
    if (!object.Has(key)) return fallback;
    const tinygltf::Value& value = object.Get(key);
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : std::nan("");
    if (number >= min && number <= max) return number;
    context.warn(place + "/" + key, "expected a number from {} to {}; {} is used", min, max, fallback);
    return fallback;
}

glm::dvec2 vec2Or(ImportContext& context, const tinygltf::Value& object, const std::string& key,
                  glm::dvec2 fallback, const std::string& place) {
    if (!object.Has(key)) return fallback;
    const tinygltf::Value& value = object.Get(key);
    if (value.IsArray() && value.ArrayLen() == 2 && value.Get(0).IsNumber() && value.Get(1).IsNumber()) {
        return {value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble()};
    }
    context.warn(place + "/" + key, "expected an array of 2 numbers; ignored");
    return fallback;
}

WrapMode wrapMode(int gltfWrap) {
    if (gltfWrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return WrapMode::ClampToEdge;
    if (gltfWrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return WrapMode::MirroredRepeat;
    return WrapMode::Repeat;
}

class MaterialImporter {
  public:
    MaterialImporter(ImportContext& context, const tinygltf::Model& model)
        : context_(context), model_(model), images_(context) {}

    void run();

  private:
    TextureRef texture(int index, int texCoord, const Extensions& extensions, const std::string& place);
    template<typename Info>
    TextureRef texture(const Info& info, const std::string& place) {
        return texture(info.index, info.texCoord, info.extensions, place);
    }
    Material material(const tinygltf::Material& source, const std::string& place);
    void readExtensions(const tinygltf::Material& source, const std::string& place, Material& material);
    void readSpecularGlossiness(const tinygltf::Value& extension, const std::string& place,
                                Material& material);

    ImportContext& context_;
    const tinygltf::Model& model_;
    ImageLoader images_;
};

TextureRef MaterialImporter::texture(int index, int texCoord, const Extensions& extensions,
                                     const std::string& place) {
    TextureRef ref;
    if (index < 0 || index >= static_cast<int>(model_.textures.size())) return ref;
    const tinygltf::Texture& source = model_.textures[index];
    if (source.source < 0) {
        context_.warnOnce(fmt::format("source {}", index), fmt::format("/textures/{}", index),
                          "expected the property 'source'; the texture is left out");
        return ref;
    }
    ref.image = images_.request(source.source, place);
    ref.texCoord = texCoord;
    if (source.sampler >= 0) {
        const tinygltf::Sampler& sampler = model_.samplers[source.sampler];
        ref.wrapS = wrapMode(sampler.wrapS);
        ref.wrapT = wrapMode(sampler.wrapT);
        ref.nearestFilter = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    if (const auto* transform = findExtension(extensions, "KHR_texture_transform")) {
        const std::string transformPlace = place + "/extensions/KHR_texture_transform";
        ref.offset = vec2Or(context_, *transform, "offset", ref.offset, transformPlace);
        ref.scale = vec2Or(context_, *transform, "scale", ref.scale, transformPlace);
        ref.rotationRad = numberOr(context_, *transform, "rotation", 0.0, -1e6, 1e6, transformPlace);
        ref.texCoord = static_cast<int>(
            numberOr(context_, *transform, "texCoord", ref.texCoord, 0.0, 255.0, transformPlace));
    }
    if (ref.texCoord > 1) {
        context_.warn(place, "expected texture coordinate set 0 or 1, found {}; set 0 is used", ref.texCoord);
        ref.texCoord = 0;
    }
    return ref;
}

void MaterialImporter::readSpecularGlossiness(const tinygltf::Value& extension, const std::string& place,
                                              Material& material) {
    context_.warnOnce("specular-glossiness", place,
                      "KHR_materials_pbrSpecularGlossiness is read as a dielectric of its diffuse colour");
    material.metallicFactor = 0.0;
    material.roughnessFactor = 1.0 - numberOr(context_, extension, "glossinessFactor", 1.0, 0.0, 1.0, place);
    if (extension.Has("diffuseFactor")) {
        const tinygltf::Value& factor = extension.Get("diffuseFactor");
        for (int i = 0; i < 4 && factor.IsArray() && factor.ArrayLen() == 4; ++i) {
            const tinygltf::Value& value = factor.Get(i);
            if (value.IsNumber())
                material.baseColorFactor[i] = std::clamp(value.GetNumberAsDouble(), 0.0, 1.0);
        }
    }
    if (!extension.Has("diffuseTexture")) return;
    const tinygltf::Value& info = extension.Get("diffuseTexture");
    if (!info.IsObject()) return;
    const int index = static_cast<int>(numberOr(context_, info, "index", -1.0, 0.0, 1e9, place));
    const int texCoord = static_cast<int>(numberOr(context_, info, "texCoord", 0.0, 0.0, 255.0, place));
    Extensions extensions;
    if (info.Has("extensions") && info.Get("extensions").IsObject()) {
        extensions = info.Get("extensions").Get<tinygltf::Value::Object>();
    }
    material.baseColor = texture(index, texCoord, extensions, place + "/diffuseTexture");
}

void MaterialImporter::readExtensions(const tinygltf::Material& source, const std::string& place,
                                      Material& material) {
    const std::string prefix = place + "/extensions/";
    if (const auto* extension = findExtension(source.extensions, "KHR_materials_emissive_strength")) {
        material.emissiveNit *= numberOr(context_, *extension, "emissiveStrength", 1.0, 0.0, 1e12,
                                         prefix + "KHR_materials_emissive_strength");
    }
    if (const auto* extension = findExtension(source.extensions, "KHR_materials_transmission")) {
        material.transmission = numberOr(context_, *extension, "transmissionFactor", 0.0, 0.0, 1.0,
                                         prefix + "KHR_materials_transmission");
    }
    if (const auto* extension = findExtension(source.extensions, "KHR_materials_pbrSpecularGlossiness")) {
        readSpecularGlossiness(*extension, prefix + "KHR_materials_pbrSpecularGlossiness", material);
    }
    if (source.extensions.contains("KHR_materials_unlit")) {
        // The tool shows light; a surface that ignores it would hide what is to be judged.
        context_.warnOnce("unlit", prefix + "KHR_materials_unlit",
                          "unlit materials are lit as rough dielectrics");
        material.metallicFactor = 0.0;
        material.roughnessFactor = 1.0;
    }
}

Material MaterialImporter::material(const tinygltf::Material& source, const std::string& place) {
    Material result;
    result.name = source.name;
    const auto& pbr = source.pbrMetallicRoughness;
    const std::string pbrPlace = place + "/pbrMetallicRoughness";
    for (int i = 0; i < 4 && pbr.baseColorFactor.size() == 4; ++i)
        result.baseColorFactor[i] = pbr.baseColorFactor[i];
    result.baseColor = texture(pbr.baseColorTexture, pbrPlace + "/baseColorTexture");
    result.metallicFactor = pbr.metallicFactor;
    result.roughnessFactor = pbr.roughnessFactor;
    result.metallicRoughness = texture(pbr.metallicRoughnessTexture, pbrPlace + "/metallicRoughnessTexture");
    result.normal = texture(source.normalTexture, place + "/normalTexture");
    result.normalScale = source.normalTexture.scale;
    result.emissive = texture(source.emissiveTexture, place + "/emissiveTexture");
    for (int i = 0; i < 3 && source.emissiveFactor.size() == 3; ++i)
        result.emissiveNit[i] = source.emissiveFactor[i];
    if (source.alphaMode == "MASK") result.alphaMode = AlphaMode::Mask;
    if (source.alphaMode == "BLEND") result.alphaMode = AlphaMode::Blend;
    result.alphaCutoff = source.alphaCutoff;
    result.doubleSided = source.doubleSided;
    readExtensions(source, place, result);
    return result;
}

void MaterialImporter::run() {
    for (std::size_t i = 0; i < model_.materials.size(); ++i) {
        context_.scene.materials.push_back(material(model_.materials[i], fmt::format("/materials/{}", i)));
    }
    const std::vector<bool> loaded = images_.load();
    for (Material& each : context_.scene.materials) {
        for (TextureRef* ref : {&each.baseColor, &each.metallicRoughness, &each.normal, &each.emissive}) {
            if (ref->image >= 0 && !loaded[ref->image]) ref->image = -1;
        }
    }
}

} // namespace

void importMaterials(ImportContext& context, const tinygltf::Model& model) {
    MaterialImporter(context, model).run();
}

} // namespace kilolux::gltf
