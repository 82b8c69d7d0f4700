// SPDX-License-Identifier: GPL-3.0-or-later
// Draws segments as instances of one square, which the vertex shader stretches along each line to its width in pixels, or to
// the corners of a band.

import {
    BufferAttribute, DoubleSide, DynamicDrawUsage, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, RawShaderMaterial, Vector2,
} from 'three';

import type {Segments} from './segments';

const vertexShader = `
precision highp float;
uniform mat4 projectionMatrix, modelViewMatrix;
uniform vec2 halfSize; // half the viewport's size, pixels
uniform float scale; // picture pixels per CSS pixel
in vec2 corner; // position along and across the line, -1 to 1
in vec4 ends;
in float width;
in vec4 colour;
in vec4 sides;
out vec4 shown;
void main() {
    mat4 toClip = projectionMatrix * modelViewMatrix;
    vec2 from = (toClip * vec4(ends.xy, 0.0, 1.0)).xy * halfSize, to = (toClip * vec4(ends.zw, 0.0, 1.0)).xy * halfSize;
    vec2 way = to - from;
    float far = length(way), across = 0.5 * max(1.0, width * scale);
    vec2 along = far > 0.0 ? way / far : vec2(1.0, 0.0);
    // Ends extend by half the line's width, so that the lines of a chain join.
    vec2 at = (corner.x < 0.0 ? from : to) + across * (corner.x * along + corner.y * vec2(-along.y, along.x));
    if (sides != vec4(0.0)) {
        vec2 place = corner.x < 0.0 ? ends.xy + corner.y * sides.xy : ends.zw + corner.y * sides.zw;
        at = (toClip * vec4(place, 0.0, 1.0)).xy * halfSize;
    }
    shown = colour;
    gl_Position = vec4(at / halfSize, 0.0, 1.0);
}`;

const fragmentShader = `
precision mediump float;
in vec4 shown;
out vec4 result;
void main() { result = shown; }`;

export class SegmentLayer {
    readonly mesh: Mesh<InstancedBufferGeometry, RawShaderMaterial>;
    private capacity = 0;

    constructor(order: number) {
        this.mesh = new Mesh(new InstancedBufferGeometry(), new RawShaderMaterial({
            glslVersion: GLSL3, vertexShader, fragmentShader, side: DoubleSide, depthTest: false, depthWrite: false, transparent: true,
            uniforms: {halfSize: {value: new Vector2(1, 1)}, scale: {value: 1}},
        }));
        this.mesh.frustumCulled = false;
        this.mesh.renderOrder = order;
        this.mesh.visible = false;
    }

    show(segments: Segments): void {
        this.mesh.visible = segments.count > 0;
        if (segments.count === 0) return;
        if (this.capacity !== segments.widths.length) this.allocate(segments);
        const {geometry} = this.mesh;
        geometry.instanceCount = segments.count;
        for (const name of ['ends', 'width', 'colour', 'sides']) {
            const attribute = geometry.getAttribute(name) as InstancedBufferAttribute;
            attribute.clearUpdateRanges();
            attribute.addUpdateRange(0, segments.count * attribute.itemSize);
            attribute.needsUpdate = true;
        }
    }

    /// Sets the viewport's size and the number of picture pixels per CSS pixel.
    setScale(width: number, height: number, scale: number): void {
        (this.mesh.material.uniforms['halfSize']!.value as Vector2).set(width / 2, height / 2);
        this.mesh.material.uniforms['scale']!.value = scale;
    }

    /// Creates new buffers over the enlarged arrays.
    private allocate(segments: Segments): void {
        this.capacity = segments.widths.length;
        const geometry = new InstancedBufferGeometry();
        geometry.setAttribute('corner', new BufferAttribute(new Float32Array([-1, -1, 1, -1, 1, 1, -1, 1]), 2));
        geometry.setIndex([0, 1, 2, 0, 2, 3]);
        const instanced = (values: Float32Array | Uint8Array, size: number, normalised = false) => {
            const attribute = new InstancedBufferAttribute(values, size, normalised);
            attribute.setUsage(DynamicDrawUsage);
            return attribute;
        };
        geometry.setAttribute('ends', instanced(segments.ends, 4));
        geometry.setAttribute('width', instanced(segments.widths, 1));
        geometry.setAttribute('colour', instanced(segments.colours, 4, true));
        geometry.setAttribute('sides', instanced(segments.sides, 4));
        this.mesh.geometry.dispose();
        this.mesh.geometry = geometry;
    }
}
