export function createFiles() { return { redraw() {}, retry() {}, open() {}, draw() {}, mark() {}, escape() {}, tool: '' }; }
