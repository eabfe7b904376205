export function createSection() { return { redraw() {}, retry() {}, open() {}, draw() {}, mark() {}, escape() {}, tool: '' }; }
